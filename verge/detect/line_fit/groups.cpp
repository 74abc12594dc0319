// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/detect/line_fit/groups.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

#include "verge/cluster/breakpoints.hpp"
#include "verge/cluster/kmeans.hpp"
#include "verge/cluster/silhouette.hpp"
#include "verge/detect/line_fit/kerb_edges.hpp"

namespace verge::detect::line_fit {
namespace {

/// Each layer parted at its breakpoints, and what layers see near to each other put together.
std::vector<std::vector<std::size_t>> clusters_of(std::span<const LayerPoint> points,
                                                  const ObjectsConfig& config) {
  const std::vector<Vec2> places = places_of(points);
  std::vector<std::vector<std::size_t>> clusters;
  for (const auto& [begin, end] : layers_of(points)) {
    for (auto& cluster : cluster::breakpoint_clusters(
             std::span(places).subspan(begin, end - begin),
             {.incidence_rad = config.incidence_rad, .sigma_m = config.range_sigma_m})) {
      for (std::size_t& i : cluster) i += begin;
      clusters.push_back(std::move(cluster));
    }
  }
  return cluster::merge_near(places, clusters, config.layer_gap_m);
}

Groups kerb_groups(std::span<const LayerPoint> points, std::span<const Object> objects,
                   const KerbConfig& config) {
  Groups groups;
  KerbReturns returns = kerb_returns(points, objects, config);
  for (auto* side : {&returns.left, &returns.right}) {
    if (!side->empty()) groups.points.push_back(std::move(*side));
  }
  return groups;
}

Groups all_points(std::size_t size) {
  Groups groups;
  if (size == 0) return groups;
  groups.points.emplace_back(size);
  std::iota(groups.points.front().begin(), groups.points.front().end(), std::size_t{0});
  return groups;
}

}  // namespace

Groups kmeans_groups(std::span<const LayerPoint> points, const LineFitConfig& config) {
  constexpr std::size_t kMost = 16;
  const std::vector<Vec2> places = places_of(points);
  const auto k = static_cast<std::size_t>(config.clusters);
  const auto result = k > 0 ? cluster::kmeans(places, cluster::farthest_first(places, k))
                            : cluster::choose_k(places, kMost).clusters;
  Groups groups{cluster::clusters_of(result.label, result.centres.size()), result.centres};
  std::erase_if(groups.points, [](const auto& group) { return group.empty(); });
  return groups;
}

Groups groups_of(std::span<const LayerPoint> points, std::span<const Object> objects, EdgeGrouping grouping,
                 const LineFitConfig& config) {
  switch (grouping) {
    case EdgeGrouping::kKerb:
      return kerb_groups(points, objects, config.kerb);
    case EdgeGrouping::kClusters:
      return {clusters_of(points, config.objects), {}};
    case EdgeGrouping::kKMeans:
      return kmeans_groups(points, config);
    case EdgeGrouping::kNone:
      break;
  }
  return all_points(points.size());
}

}  // namespace verge::detect::line_fit
