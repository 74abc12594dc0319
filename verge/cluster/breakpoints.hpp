// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "verge/core/vec.hpp"

namespace verge::cluster {

/// The adaptive breakpoint detector of Borges and Aldon, "Line Extraction in 2D Range Images for Mobile
/// Robotics" (Journal of Intelligent and Robotic Systems 40, 2004), section 3.1.
struct BreakpointOptions {
  double incidence_rad = 0.17453292519943295;  ///< Lambda: flatter than this no surface is followed.
  double sigma_m = 0.03;                       ///< Of the ranges.
  double step_max_rad = 0.1;  ///< Ours: farther apart in direction, two points are of no common surface.
  /// A point is held against those of so many directions before its own (several echoes of a shot have one):
  /// 1 is the paper's; more follow a surface past what stands before it.
  std::size_t look_back = 1;
  /// Ours: lambda is this for neighbours that are known to be of one flat surface. Either they go straight
  /// on, within `straight_m` of the line through the two points before; or they differ by no more than
  /// `beside_m` in y, where surfaces along x are met flatter than incidence_rad (parked cars stand along a
  /// road).
  double flat_rad = 0.17453292519943295;
  double straight_m = 0.0;
  double beside_m = 0.0;
};

/// D_max = r sin(step) / sin(lambda - step) + 3 sigma: how far the next point of a surface can be from one at
/// the range r, `step_rad` (>= 0) on, metres. A step of lambda or more leaves no surface: 3 sigma.
[[nodiscard]] double breakpoint_gap_m(double range_m, double step_rad, double incidence_rad, double sigma_m);

/// Clusters of points that a scanner at the origin saw one after the other: each point is joined to the
/// nearest of those before it from which no breakpoint separates it; and likewise from the other end (ours: a
/// surface that is met flatter and flatter is followed from where it is met steeply), so that a mirror
/// changes nothing. Indices ascending; clusters in the order of their first points. O(n look_back).
[[nodiscard]] std::vector<std::vector<std::size_t>> breakpoint_clusters(
    std::span<const Vec2> points, const BreakpointOptions& options = {});

/// Clusters put together where a point of the one lies within gap_m of a point of the other, again and again
/// (what several layers saw of one thing). `clusters` are not empty and hold indices into `points`; what
/// comes back is ordered as breakpoint_clusters orders it. O(n^2) at worst, for clusters that overlap.
[[nodiscard]] std::vector<std::vector<std::size_t>> merge_near(
    std::span<const Vec2> points, std::span<const std::vector<std::size_t>> clusters, double gap_m);

}  // namespace verge::cluster
