// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "verge/detect/gradient/candidates.hpp"
#include "verge/detect/gradient/gradient.hpp"
#include "verge/detect/gradient/gradient_points.hpp"
#include "verge/detect/gradient/obstacles.hpp"
#include "verge/detect/gradient/regions.hpp"

namespace verge::detect::gradient {

/// A scan line in one region, and what II-1 (2) and (3) make of it.
struct ScanLine {
  Layer layer;
  GradientPoints points;
  LayerClusters clusters;
  std::optional<Candidate> candidate;  ///< Where it meets the boundary; as printed, none is chosen.
};

/// II-1 (2) and (3), K and clusters, fixed reading: the regions a to d lie along the road (road_axis.hpp),
/// which is found from the vehicle outward. Ahead, then behind; from the innermost scan line outward; left,
/// then right.
[[nodiscard]] std::vector<ScanLine> scan_lines(const std::vector<LowRing>& low, const Obstacles& obstacles,
                                               const GradientConfig& config);

/// The same, paper reading: by region.
[[nodiscard]] std::vector<ScanLine> scan_lines_as_printed(const std::vector<LowRing>& low,
                                                          const GradientConfig& config);

/// The boundary points in one region, in the order of the lines.
[[nodiscard]] std::vector<Candidate> candidates_in(const std::vector<ScanLine>& lines, Quadrant region);

}  // namespace verge::detect::gradient
