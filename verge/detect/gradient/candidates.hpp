// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "verge/core/vec.hpp"
#include "verge/detect/gradient/gradient.hpp"
#include "verge/detect/gradient/gradient_points.hpp"
#include "verge/detect/gradient/obstacles.hpp"
#include "verge/detect/gradient/regions.hpp"

namespace verge::detect::gradient {

/// Gradient points of one layer parted into clusters, each a list of indices into GradientPoints, ascending;
/// from the road outward.
struct LayerClusters {
  std::size_t K = 0;
  std::vector<std::vector<std::size_t>> clusters;
};

/// II-1 (3): d_i = |p_i - p_{i+1}|, d_threshold = m, K; the clusters; and those with at least points_min
/// points. Fixed reading: K = 1 + #{i : d_i > m}, with m by range (gap_min_m, gap_factor), and the K runs or
/// k-means from their means (config.clustering). Paper reading: the printed loop's K and k-means from K
/// points far apart.
[[nodiscard]] LayerClusters cluster_layer(const Layer& layer, const GradientPoints& points,
                                          const GradientConfig& config);

/// Where one scan line meets the boundary.
struct Candidate {
  std::size_t ring = 0;
  double elevation_rad = 0.0;
  Vec3 foot;              ///< Level frame; the foot of the step, on the road's side.
  double height_m = 0.0;  ///< Of the step over its foot, as far as the scan line climbs it.
  bool obstacle = false;  ///< High returns stand above it: part of a vehicle or wall.
};

/// The boundary point of one layer: the foot of the first cluster outward. None where there is no cluster, or
/// the first rise is higher than rise_max_m: there the road ends at an obstacle.
[[nodiscard]] std::optional<Candidate> first_outward(const Layer& layer, const GradientPoints& points,
                                                     const LayerClusters& clusters,
                                                     const Obstacles& obstacles,
                                                     const GradientConfig& config);

}  // namespace verge::detect::gradient
