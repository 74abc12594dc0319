// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <span>

#include "verge/core/vec.hpp"

namespace verge::fit {

/// Whether no coordinate is infinite or not a number.
[[nodiscard]] inline bool all_finite(std::span<const Vec2> points) {
  return std::ranges::all_of(points, [](Vec2 p) { return std::isfinite(p.x) && std::isfinite(p.y); });
}

}  // namespace verge::fit
