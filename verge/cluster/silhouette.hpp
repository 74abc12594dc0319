// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "verge/cluster/kmeans.hpp"
#include "verge/core/vec.hpp"

namespace verge::cluster {

/// How well the clusters are told apart: the mean silhouette of the points (Rousseeuw 1987), from -1 to 1. A
/// point's is (b - a) / max(a, b), a its mean distance from the others of its cluster, b the least of its
/// mean distances from the other clusters; 0 where it is alone. `label` are indices below k. 0 where fewer
/// than two clusters have points. O(n^2).
[[nodiscard]] double silhouette(std::span<const Vec2> points, std::span<const std::size_t> label,
                                std::size_t k);

struct ChooseOptions {
  /// Clusters are worth it from this mean silhouette on: "a strong structure has been found" (Kaufman and
  /// Rousseeuw, "Finding Groups in Data", 1990, from 0.71 on). A straight edge that is cut in its middle, and
  /// is one thing, has 2 - 1.25 ln 3 = 0.627.
  double least_silhouette = 0.71;
  KMeansOptions kmeans = {};
};

struct ChosenClusters {
  KMeansResult<Vec2> clusters;      ///< As many centres as were chosen; none without points.
  std::vector<double> silhouettes;  ///< For k = 2, 3, ...: as many as were tried.
};

/// k-means with the number of clusters chosen (the paper leaves it at 2): from farthest_first, k = 2 ..
/// k_max, that of the greatest mean silhouette, of equals the fewest; and 1 where none reaches
/// `least_silhouette`. Not more than there are distinct points. O(n^2 k_max).
[[nodiscard]] ChosenClusters choose_k(std::span<const Vec2> points, std::size_t k_max,
                                      const ChooseOptions& options = {});

}  // namespace verge::cluster
