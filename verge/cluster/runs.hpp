// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "verge/core/vec.hpp"

namespace verge::cluster {

/// Points begin .. end - 1 of a sequence.
struct PointRun {
  std::size_t begin = 0;
  std::size_t end = 0;

  [[nodiscard]] std::size_t size() const { return end - begin; }
  friend bool operator==(const PointRun&, const PointRun&) = default;
};

/// d_i = |p_i - p_{i+1}| of n points in their order: n - 1 distances, metres (paper 3, II; P3-6). Fewer than
/// two points: none.
[[nodiscard]] std::vector<double> adjacent_distances(std::span<const Vec2> points);
[[nodiscard]] std::vector<double> adjacent_distances(std::span<const Vec3> points);

/// The runs that gaps separate: a new one begins at point i + 1 wherever d_i > m, m = d_threshold. `d` are
/// the adjacent distances of `points` points; `m` holds one threshold for each of them, or one for all. Every
/// point is in one run; no points give no runs. The number of runs is K = 1 + #{i : d_i > m} (A2.2-2).
[[nodiscard]] std::vector<PointRun> gap_separated_runs(std::size_t points, std::span<const double> d,
                                                       std::span<const double> m);
[[nodiscard]] std::vector<PointRun> gap_separated_runs(std::size_t points, std::span<const double> d,
                                                       double m);

/// K of the paper's loop as printed (II; P3-7): `for i = 1:n, if d_i > d_threshold, K = i`, which gives the
/// place (from 1) of the last gap and not the number of clusters; 1 where there is no gap. The loop ends at
/// the last distance that exists. Kept for the `paper` reading.
[[nodiscard]] std::size_t cluster_count_as_printed(std::span<const double> d, std::span<const double> m);
[[nodiscard]] std::size_t cluster_count_as_printed(std::span<const double> d, double m);

/// The runs of more than `threshold` points (paper 3, II: "greater than a certain threshold").
[[nodiscard]] std::vector<PointRun> keep_larger_than(std::span<const PointRun> runs, std::size_t threshold);

/// The mean point of each run: where k-means starts from.
[[nodiscard]] std::vector<Vec2> run_means(std::span<const Vec2> points, std::span<const PointRun> runs);
[[nodiscard]] std::vector<Vec3> run_means(std::span<const Vec3> points, std::span<const PointRun> runs);

}  // namespace verge::cluster
