// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "verge/core/vec.hpp"

// Points out of the raw numbers that property tests draw.

namespace verge::fit::testing {

using RawPlaces = std::vector<std::pair<std::int16_t, std::int16_t>>;
using RawSteps = std::vector<std::pair<std::uint8_t, std::int8_t>>;

/// Anywhere within 128 m, in steps of 1/256 m.
[[nodiscard]] inline std::vector<Vec2> places_of(const RawPlaces& raw) {
  std::vector<Vec2> points;
  for (const auto& [x, y] : raw) points.push_back({x / 256.0, y / 256.0});
  return points;
}

/// One after the other, from 1 cm to 4 m apart in x.
[[nodiscard]] inline std::vector<Vec2> steps_of(const RawSteps& raw) {
  std::vector<Vec2> points;
  double x = 0.0;
  for (const auto& [dx, y] : raw) points.push_back({x += 0.01 + dx / 64.0, y / 16.0});
  return points;
}

}  // namespace verge::fit::testing
