// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

#include "verge/sensor/velodyne/facts.hpp"

namespace verge::sensor::velodyne {

/// A measured distance with its corrections, which near by differ ahead and to the side.
struct CorrectedDistance {
  double ahead_m = 0.0;
  double side_m = 0.0;
};

/// Up to where the corrections of near points count.
inline constexpr double kFarM = 25.04;

/// The distance as the manual of the S3 corrects it ("calibration"): linearly between two distances, ahead
/// and aside apart. `near`: with the corrections of near points; `level_cos`, `level_sin`: cosine of the
/// elevation times cosine and sine of the beam's azimuth.
[[nodiscard]] inline CorrectedDistance corrected(const LaserCorrection& laser, double measured_m, bool near,
                                                 double level_cos, double level_sin) {
  constexpr double kNearAheadM = 1.93;
  constexpr double kNearSideM = 2.40;
  const double far_m = measured_m + laser.distance_m;
  if (!near || !laser.near) return {far_m, far_m};
  const double along = (std::abs(far_m * level_cos) - kNearAheadM) / (kFarM - kNearAheadM);
  const double across = (std::abs(far_m * level_sin) - kNearSideM) / (kFarM - kNearSideM);
  return {measured_m + std::lerp(laser.near->ahead_m, laser.distance_m, along),
          measured_m + std::lerp(laser.near->side_m, laser.distance_m, across)};
}

}  // namespace verge::sensor::velodyne
