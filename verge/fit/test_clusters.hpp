// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>
#include <vector>

#include "verge/core/vec.hpp"

// What clusters of a four-layer scanner look like from above.

namespace verge::fit::testing {

/// x and y of the 14 points of paper 2's Fig. 12, as printed.
[[nodiscard]] inline std::vector<Vec2> figure_12() {
  return {{13.3743, 9.1919}, {13.8328, 9.1557},  {14.2941, 9.1063}, {14.1354, 8.6622}, {17.5200, 10.7963},
          {14.1207, 8.3177}, {17.4980, 10.3071}, {17.4751, 9.9879}, {17.4569, 9.7764}, {17.4364, 9.5658},
          {17.4135, 9.3566}, {17.4591, 9.1857},  {17.4230, 8.8735}, {17.7596, 8.9516}};
}

/// A kerb along 30 m from 5 m ahead on: y = 3 + 0.1 x with 3 cm of noise.
[[nodiscard]] inline std::vector<Vec2> straight_edge(int count, std::uint32_t seed) {
  std::mt19937 engine(seed);
  std::normal_distribution<double> noise(0.0, 0.03);
  std::vector<Vec2> points;
  for (int i = 0; i < count; ++i) {
    const double x = 5.0 + 30.0 * i / (count - 1);
    points.push_back({x, 3.0 + 0.1 * x + noise(engine)});
  }
  return points;
}

/// A car ahead on the right as a scanner sees it every `step_deg`: its rear (at x = 8 m, y from -4 to -2.2 m)
/// and its left side (4.5 m), with 3 cm of noise in range. As y on x it is a step at its corner.
[[nodiscard]] inline std::vector<Vec2> l_shaped_car(double step_deg, std::uint32_t seed) {
  std::mt19937 engine(seed);
  std::normal_distribution<double> noise(0.0, 0.03);
  std::vector<Vec2> points;
  for (double degrees = -30.0; degrees < -5.0; degrees += step_deg) {
    const double azimuth = degrees * std::numbers::pi / 180.0;
    const Vec2 way{std::cos(azimuth), std::sin(azimuth)};
    double range = 8.0 / way.x;
    if (range * way.y > -2.2) range = -2.2 / way.y;
    if (range * way.y >= -4.0 && range * way.x <= 12.5) points.push_back((range + noise(engine)) * way);
  }
  return points;
}

}  // namespace verge::fit::testing
