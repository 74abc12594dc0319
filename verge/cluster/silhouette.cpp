// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/cluster/silhouette.hpp"

#include <algorithm>
#include <cassert>
#include <limits>
#include <utility>

namespace verge::cluster {
namespace {

/// The sums of each point's distances from the points of each cluster, k a point.
std::vector<double> distance_sums(std::span<const Vec2> points, std::span<const std::size_t> label,
                                  std::size_t k) {
  std::vector<double> sums(points.size() * k, 0.0);
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (std::size_t j = i + 1; j < points.size(); ++j) {
      const double d = distance(points[i], points[j]);
      sums[i * k + label[j]] += d;
      sums[j * k + label[i]] += d;
    }
  }
  return sums;
}

double silhouette_of_point(std::span<const double> sums, std::span<const std::size_t> sizes,
                           std::size_t own) {
  if (sizes[own] < 2) return 0.0;
  const double a = sums[own] / static_cast<double>(sizes[own] - 1);
  double b = std::numeric_limits<double>::infinity();
  for (std::size_t c = 0; c < sums.size(); ++c) {
    if (c != own && sizes[c] > 0) b = std::min(b, sums[c] / static_cast<double>(sizes[c]));
  }
  const double greater = std::max(a, b);
  return greater > 0.0 ? (b - a) / greater : 0.0;
}

}  // namespace

double silhouette(std::span<const Vec2> points, std::span<const std::size_t> label, std::size_t k) {
  assert(label.size() == points.size());
  std::vector<std::size_t> sizes(k, 0);
  for (const std::size_t c : label) ++sizes[c];
  if (std::ranges::count_if(sizes, [](std::size_t size) { return size > 0; }) < 2) return 0.0;
  const std::vector<double> sums = distance_sums(points, label, k);
  double total = 0.0;
  for (std::size_t i = 0; i < points.size(); ++i)
    total += silhouette_of_point(std::span(sums).subspan(i * k, k), sizes, label[i]);
  return total / static_cast<double>(points.size());
}

ChosenClusters choose_k(std::span<const Vec2> points, std::size_t k_max, const ChooseOptions& options) {
  const std::vector<Vec2> seeds = farthest_first(points, std::max<std::size_t>(k_max, 1));
  ChosenClusters chosen;
  chosen.clusters =
      kmeans(points, std::span(seeds).first(std::min<std::size_t>(1, seeds.size())), options.kmeans);
  double best = -1.0;
  for (std::size_t k = 2; k <= seeds.size(); ++k) {  // the seeds of k are the first k of those of k_max
    auto clusters = kmeans(points, std::span(seeds).first(k), options.kmeans);
    chosen.silhouettes.push_back(silhouette(points, clusters.label, k));
    if (chosen.silhouettes.back() < options.least_silhouette || chosen.silhouettes.back() <= best) continue;
    best = chosen.silhouettes.back();
    chosen.clusters = std::move(clusters);
  }
  return chosen;
}

}  // namespace verge::cluster
