// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "verge/core/vec.hpp"
#include "verge/model/scene.hpp"

namespace verge::eval {

/// Corners of an object's footprint, counter-clockwise, the left front one first. Metres.
[[nodiscard]] std::array<Vec2, 4> footprint(const Object& object);

/// Area that the two footprints share, m2.
[[nodiscard]] double shared_area(const Object& a, const Object& b);

/// Intersection over union of the two footprints; 0 where either has no area.
[[nodiscard]] double intersection_over_union(const Object& a, const Object& b);

}  // namespace verge::eval
