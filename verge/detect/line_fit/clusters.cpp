// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/detect/line_fit/clusters.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <optional>
#include <utility>

#include "verge/cluster/breakpoints.hpp"
#include "verge/core/angle.hpp"

namespace verge::detect::line_fit {
namespace {

using Clusters = std::vector<std::vector<std::size_t>>;

cluster::BreakpointOptions breakpoints(const ObjectsConfig& config) {
  constexpr double kBeside_m = 0.2;
  constexpr double kStraight_m = 0.1;
  constexpr double kStepMax_rad = deg_to_rad(1.2);  // a LUX's coarsest step, and the vehicle's turning
  return {.incidence_rad = config.incidence_rad,
          .sigma_m = config.range_sigma_m,
          .step_max_rad = kStepMax_rad,
          .look_back = static_cast<std::size_t>(config.look_back),
          .flat_rad = config.flat_rad,
          .straight_m = kStraight_m,
          .beside_m = kBeside_m};
}

/// So much below the least height, returns still join what stands: the lower edge of a car's body is at that
/// height.
constexpr double kWeak_m = 0.05;

/// The indices of a layer's points above the road.
std::vector<std::size_t> standing(std::span<const LayerPoint> points, std::size_t layer,
                                  double height_min_m) {
  std::vector<std::size_t> indices;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (points[i].layer == layer && points[i].place.z >= height_min_m) indices.push_back(i);
  }
  return indices;
}

Clusters clusters_of_layers(std::span<const LayerPoint> points, const ObjectsConfig& config) {
  Clusters clusters;
  for (std::size_t layer = 0; !points.empty() && layer <= points.back().layer; ++layer) {
    const auto indices = standing(points, layer, config.object_height_min_m - kWeak_m);
    std::vector<Vec2> places;
    for (const std::size_t i : indices) places.push_back(points[i].place.xy());
    for (auto& cluster : cluster::breakpoint_clusters(places, breakpoints(config))) {
      for (std::size_t& i : cluster) i = indices[i];
      clusters.push_back(std::move(cluster));
    }
  }
  return clusters;
}

/// What the layers see in one direction: the nearest of it, and where its points stand in the cluster.
struct Column {
  Vec2 place;
  std::size_t begin = 0;
};

/// From left to right; the cluster's points must be in that order.
std::vector<Column> columns_of(std::span<const LayerPoint> points, const std::vector<std::size_t>& cluster) {
  constexpr double kSame_rad = 1e-3;  // half of the finest step from one pair of layers to the other
  std::vector<Column> columns;
  double azimuth_rad = 0.0;
  for (std::size_t k = 0; k < cluster.size(); ++k) {
    const LayerPoint& p = points[cluster[k]];
    if (columns.empty() || azimuth_rad - p.azimuth_rad > kSame_rad) {
      columns.push_back({p.place.xy(), k});
      azimuth_rad = p.azimuth_rad;
    } else if (norm(p.place.xy()) < norm(columns.back().place)) {
      columns.back().place = p.place.xy();
    }
  }
  return columns;
}

/// How far b stands behind the line from a to c, along the ray to b.
double behind_m(Vec2 a, Vec2 b, Vec2 c) {
  const double at_b = cross(b, c - a);
  return at_b == 0.0 ? 0.0 : norm(b) * (1.0 - cross(a, c - a) / at_b);
}

/// Columns [begin, end) of a thing.
struct Stretch {
  std::size_t begin = 0;
  std::size_t end = 0;
};

/// Where the outline goes in most, so that two convex things meet there: the first column of the second; none
/// where it goes in by less than noise_m.
std::optional<std::size_t> deepest_dent(const std::vector<Column>& columns, Stretch stretch, double noise_m) {
  std::optional<std::size_t> dent;
  double deepest_m = noise_m;
  for (std::size_t i = stretch.begin + 1; i + 1 < stretch.end; ++i) {
    const Vec2 before = columns[i - 1].place;
    const Vec2 after = columns[i + 1].place;
    const double deep_m = behind_m(before, columns[i].place, after);
    if (deep_m < deepest_m) continue;
    deepest_m = deep_m;
    dent = norm(before) < norm(after) ? i : i + 1;  // what stands behind is of the farther one
  }
  return dent;
}

/// Where a row may be parted that shows no dent, since what is between two things is narrower than a step
/// from column to column: at the first such step a car's length and more from its nearer end.
std::optional<std::size_t> seam_of(const std::vector<Column>& columns, Stretch stretch,
                                   const ObjectsConfig& config) {
  constexpr double kGap_m = 0.7;
  constexpr double kBeyond_m = 0.2;
  const bool from_begin = norm(columns[stretch.begin].place) <= norm(columns[stretch.end - 1].place);
  const Vec2 nearer = columns[from_begin ? stretch.begin : stretch.end - 1].place;
  for (std::size_t k = 1; k < stretch.end - stretch.begin; ++k) {
    const std::size_t i = from_begin ? stretch.begin + k : stretch.end - 1 - k;
    const std::size_t before = from_begin ? i - 1 : i + 1;
    if (distance(columns[i].place, nearer) < config.car_length_m + kBeyond_m) continue;
    if (distance(columns[i].place, columns[before].place) >= kGap_m) return from_begin ? i : before;
  }
  return std::nullopt;
}

bool is_too_long(const std::vector<Column>& columns, Stretch stretch, const ObjectsConfig& config) {
  return distance(columns[stretch.begin].place, columns[stretch.end - 1].place) > config.object_length_max_m;
}

/// Whether the stretch is wider than a vehicle both along the road and across it, as things in two lanes are
/// (or one that stands aslant, which shows no dent).
bool is_too_wide(const std::vector<Column>& columns, Stretch stretch) {
  constexpr double kWide_m = 2.4;
  const auto of = std::span(columns).subspan(stretch.begin, stretch.end - stretch.begin);
  const auto [back, front] = std::ranges::minmax(of, {}, [](const Column& c) { return c.place.x; });
  const auto [right, left] = std::ranges::minmax(of, {}, [](const Column& c) { return c.place.y; });
  return front.place.x - back.place.x > kWide_m && left.place.y - right.place.y > kWide_m;
}

/// Parts the stretch until nothing is larger than one thing can be, or nothing tells where it ends.
void part(const std::vector<Column>& columns, Stretch stretch, const ObjectsConfig& config,
          std::vector<Stretch>& parts) {
  constexpr double kDeviations = 5.0;
  const bool is_long = is_too_long(columns, stretch, config);
  std::optional<std::size_t> at;
  if (is_long || is_too_wide(columns, stretch))
    at = deepest_dent(columns, stretch, kDeviations * config.range_sigma_m);
  if (!at && is_long) at = seam_of(columns, stretch, config);
  if (!at) {
    parts.push_back(stretch);
    return;
  }
  part(columns, {stretch.begin, *at}, config, parts);
  part(columns, {*at, stretch.end}, config, parts);
}

/// The cluster, whose points stand from left to right, as one thing or several.
void add_parts(std::span<const LayerPoint> points, const std::vector<std::size_t>& cluster,
               const ObjectsConfig& config, Clusters& things) {
  const std::vector<Column> columns = columns_of(points, cluster);
  std::vector<Stretch> parts;
  part(columns, {0, columns.size()}, config, parts);
  for (const Stretch& one : parts) {
    const std::size_t end = one.end < columns.size() ? columns[one.end].begin : cluster.size();
    things.emplace_back(cluster.begin() + static_cast<std::ptrdiff_t>(columns[one.begin].begin),
                        cluster.begin() + static_cast<std::ptrdiff_t>(end));
  }
}

}  // namespace

Clusters object_clusters(std::span<const LayerPoint> points, const ObjectsConfig& config) {
  const std::vector<Vec2> places = places_of(points);
  Clusters parted;
  for (auto& cluster : cluster::merge_near(places, clusters_of_layers(points, config), config.layer_gap_m)) {
    std::erase_if(cluster, [&](std::size_t i) { return points[i].place.z < config.object_height_min_m; });
    if (cluster.empty()) continue;
    std::ranges::stable_sort(cluster, std::greater(), [&](std::size_t i) { return points[i].azimuth_rad; });
    add_parts(points, cluster, config, parted);
  }
  std::erase_if(parted, [&](const auto& cluster) {
    return cluster.size() < static_cast<std::size_t>(config.object_points);
  });
  std::ranges::stable_sort(parted, std::greater(),
                           [&](const auto& cluster) { return points[cluster.front()].azimuth_rad; });
  return parted;
}

}  // namespace verge::detect::line_fit
