// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>
#include <numbers>

namespace verge {

[[nodiscard]] constexpr double deg_to_rad(double deg) { return deg * (std::numbers::pi / 180.0); }
[[nodiscard]] constexpr double rad_to_deg(double rad) { return rad * (180.0 / std::numbers::pi); }

/// The same direction in [-pi, pi). Degenerate: NaN and infinities give NaN.
[[nodiscard]] inline double wrap_pi(double rad) {
  constexpr double kTurn = 2.0 * std::numbers::pi;
  const double wrapped = rad - kTurn * std::floor((rad + std::numbers::pi) / kTurn);
  return wrapped < std::numbers::pi ? wrapped : wrapped - kTurn;
}

/// Greatest absolute error of fast_atan2 against the exact angle, radians (tested over the plane).
inline constexpr float kFastAtan2Error = 3e-7F;

/// Direction of (x, y) from +x, counter-clockwise, in [-pi, pi], by a polynomial: branch-free, so that a loop
/// over a scan vectorises, and the same bits on every machine (the C library's atan2f is neither). (0, 0)
/// gives 0; NaN gives NaN. Source: Abramowitz and Stegun, Handbook of Mathematical Functions, 4.4.49 (2e-8
/// before rounding to float).
[[nodiscard]] inline float fast_atan2(float y, float x) {
  const float ax = std::fabs(x);
  const float ay = std::fabs(y);
  const float greater = ax > ay ? ax : ay;
  const float smaller = ax > ay ? ay : ax;
  const float t = smaller / (greater > 0.0F ? greater : 1.0F);
  const float s = t * t;
  float p = 0.0028662257F;
  p = p * s - 0.0161657367F;
  p = p * s + 0.0429096138F;
  p = p * s - 0.0752896400F;
  p = p * s + 0.1065626393F;
  p = p * s - 0.1420889944F;
  p = p * s + 0.1999355085F;
  p = p * s - 0.3333314528F;
  p = p * s + 1.0F;
  float angle = p * t;
  constexpr float kPi = std::numbers::pi_v<float>;
  angle = ay > ax ? 0.5F * kPi - angle : angle;
  angle = x < 0.0F ? kPi - angle : angle;
  return std::copysign(angle, y) + (x + y) * 0.0F;  // the last term hands on NaN and infinities as NaN
}

}  // namespace verge
