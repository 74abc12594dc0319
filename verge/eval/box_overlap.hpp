// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "verge/model/scene.hpp"

namespace verge::eval {

/// Area that the two footprints share, m2.
[[nodiscard]] double shared_area(const Object& a, const Object& b);

/// Intersection over union of the two footprints; 0 where either has no area.
[[nodiscard]] double intersection_over_union(const Object& a, const Object& b);

}  // namespace verge::eval
