// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "verge/core/vec.hpp"

namespace verge::cluster {

struct KMeansOptions {
  int max_iterations =
      100;  ///< At most so many moves of the centres; Lloyd's method ends by itself long before.
};

template <class Point>
struct KMeansResult {
  std::vector<std::size_t> label;  ///< The cluster of each point, an index into `centres`.
  std::vector<Point> centres;      ///< The mean of each cluster's points; an empty cluster's last centre.
  /// The sum of squared distances of the points from their centres, m^2, after each assignment; never rises.
  std::vector<double> objective;
  bool converged = false;  ///< The labels came to rest within max_iterations.
};

/// k-means by Lloyd's method from the given centres (paper 3, II): assign each point to its nearest centre
/// (of equals, the first), move each centre to its points' mean, until no label changes. A cluster that loses
/// all its points keeps its centre, so that labels keep their meaning. `initial` must not be empty unless
/// `points` is; then the result has no labels and the centres stay. The result depends on nothing but the
/// arguments. O(n k) an iteration.
[[nodiscard]] KMeansResult<Vec2> kmeans(std::span<const Vec2> points, std::span<const Vec2> initial,
                                        const KMeansOptions& options = {});
[[nodiscard]] KMeansResult<Vec3> kmeans(std::span<const Vec3> points, std::span<const Vec3> initial,
                                        const KMeansOptions& options = {});

/// The point nearest to the mean of all, which paper 2 (IV, Eq. (7) to (10)) takes for a cluster's centre; of
/// equals the lowest in x, then y, then z. None of no points.
[[nodiscard]] std::optional<Vec2> nearest_to_mean(std::span<const Vec2> points);
[[nodiscard]] std::optional<Vec3> nearest_to_mean(std::span<const Vec3> points);

/// k centres to start from, where none are known: first nearest_to_mean, then again and again
/// the point farthest from all centres so far. Of equals the lowest in x, then y, then z: the order of the
/// points plays no part. Fewer than k where there are fewer distinct points. O(n k).
[[nodiscard]] std::vector<Vec2> farthest_first(std::span<const Vec2> points, std::size_t k);
[[nodiscard]] std::vector<Vec3> farthest_first(std::span<const Vec3> points, std::size_t k);

/// The indices of each cluster's points, ascending; k lists, empty ones among them.
[[nodiscard]] std::vector<std::vector<std::size_t>> clusters_of(std::span<const std::size_t> label,
                                                                std::size_t k);

/// The clusters of more than `threshold` points (paper 3, II: "greater than a certain threshold"), in order.
[[nodiscard]] std::vector<std::vector<std::size_t>> keep_larger_than(
    std::span<const std::vector<std::size_t>> clusters, std::size_t threshold);

}  // namespace verge::cluster
