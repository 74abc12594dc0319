// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "verge/detect/gradient/candidates.hpp"
#include "verge/detect/gradient/gradient.hpp"
#include "verge/detect/gradient/regions.hpp"
#include "verge/detect/gradient/scan_lines.hpp"

namespace verge::detect::gradient {

/// Boundary points of one region that belong together, from the innermost scan line outward.
struct Chain {
  Quadrant region = Quadrant::kA;
  bool obstacle = false;  ///< Its points are feet of obstacles.
  std::vector<Candidate> points;
};

/// II-1 (3), "the distance of two points of the adjacent layer": boundary points of one region, at most one a
/// scan line and from the lowest up, parted wherever the next one lies farther than m or aside of the
/// direction so far. m grows with the spacing of the rings on the ground (link_factor); link_skip scan lines
/// may be missing. Chains of fewer than layers_min points are noise and dropped. Feet of obstacles chain
/// among themselves.
[[nodiscard]] std::vector<Chain> link_layers(Quadrant region, const std::vector<Candidate>& candidates,
                                             double height_m, const GradientConfig& config);

/// One stretch of boundary on one side of the road, rear end first.
struct Strand {
  bool right = false;
  bool obstacle = false;
  std::vector<Candidate> points;
  std::vector<bool> bridged;  ///< For each point but the first: no scan line crosses the boundary between it
                              ///< and the one before.
};

/// The chains of one side of the road as strands: a front chain and the rear chain that runs on from it are
/// joined beside the vehicle, where scan lines run along the boundary and none crosses it; at most link_skip
/// of those that should may be missing at either end. Obstacles stay only where they are as long as a wall.
[[nodiscard]] std::vector<Strand> join_front_and_rear(const std::vector<Chain>& chains, bool right,
                                                      double height_m, const GradientConfig& config);

/// II-1 (3), fixed reading, whole: boundary points of adjacent layers linked, front and rear joined, noise
/// dropped. Left strands first.
[[nodiscard]] std::vector<Strand> denoise(const std::vector<ScanLine>& lines, double height_m,
                                          const GradientConfig& config);

}  // namespace verge::detect::gradient
