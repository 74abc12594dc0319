// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>

#include "verge/core/vec.hpp"
#include "verge/detect/road_width/layers.hpp"

namespace verge::detect::road_width {

/// Where the face of the kerb that ends a line on one side stands on the road, in the level frame, metres: a
/// line runs across the road and then climbs along the face, and both are straight in the plane. `edge` is
/// the last point on the road, which is a spacing or two off: short of the foot where the kerb runs along the
/// road and its face begins gently, not where it turns away. None where the face has fewer than two points
/// between the road and its top, or does not lead to within 0.3 m of the edge.
[[nodiscard]] std::optional<Vec2> kerb_foot(const LayerLine& line, std::size_t edge, bool left);

}  // namespace verge::detect::road_width
