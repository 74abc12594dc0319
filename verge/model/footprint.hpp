// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cmath>

#include "verge/core/vec.hpp"
#include "verge/model/scene.hpp"

namespace verge {

/// Corners of an object seen from above, counter-clockwise, the left front one first. Metres.
[[nodiscard]] inline std::array<Vec2, 4> footprint(const Object& object) {
  const Vec2 along{std::cos(object.yaw_rad), std::sin(object.yaw_rad)};
  const Vec2 half_length = 0.5 * object.size.length_m * along;
  const Vec2 half_width = 0.5 * object.size.width_m * Vec2{-along.y, along.x};
  const Vec2 center = object.center.xy();
  return {center + half_length + half_width, center - half_length + half_width,
          center - half_length - half_width, center + half_length - half_width};
}

}  // namespace verge
