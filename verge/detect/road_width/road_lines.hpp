// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "verge/core/vec.hpp"
#include "verge/detect/road_width/layers.hpp"
#include "verge/detect/road_width/road_line.hpp"
#include "verge/detect/road_width/road_width.hpp"

namespace verge::detect::road_width {

/// A line and the road on it.
struct Road {
  LayerLine line;
  RoadLine road;
  Vec3 left{};   ///< Its left end in the level frame, metres: the last point on the road, or the kerb's foot.
  Vec3 right{};  ///< Its right end.
};

/// Steps 1 to 7 on each line, first to last; lines without a point are left out. In the combined reading
/// lines end at the kerbs' feet where these are seen.
[[nodiscard]] std::vector<Road> road_lines(std::vector<LayerLine> lines, const RoadWidthConfig& config);

/// X_max: the last line sees no farther to the side, and is not to be compared with what it cannot see. There
/// must be a line.
[[nodiscard]] double reach_m(const std::vector<Road>& roads, const RoadWidthConfig& config);

/// L, metres: the road's length on a line, cut at the reach.
[[nodiscard]] double length_m(const Road& road, double reach_m);

}  // namespace verge::detect::road_width
