// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "verge/detect/road_width/layers.hpp"
#include "verge/detect/road_width/road_line.hpp"
#include "verge/detect/road_width/road_width.hpp"

namespace verge::detect::road_width {

/// A line and the road on it.
struct Road {
  LayerLine line;
  RoadLine road;
};

/// Steps 1 to 7 on each line, first to last; lines without a point are left out.
[[nodiscard]] std::vector<Road> road_lines(std::vector<LayerLine> lines, const RoadWidthConfig& config);

/// X_max: the last line sees no farther to the side, and is not to be compared with what it cannot see. There
/// must be a line.
[[nodiscard]] double reach_m(const std::vector<Road>& roads, const RoadWidthConfig& config);

/// L, metres: the road's length on a line, cut at the reach.
[[nodiscard]] double length_m(const Road& road, double reach_m);

}  // namespace verge::detect::road_width
