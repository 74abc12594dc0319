// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/detect/line_fit/objects.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "verge/core/angle.hpp"
#include "verge/detect/line_fit/box.hpp"
#include "verge/detect/line_fit/clusters.hpp"
#include "verge/detect/line_fit/edge_ends.hpp"
#include "verge/detect/line_fit/kinds.hpp"

namespace verge::detect::line_fit {
namespace {

constexpr double kQuarterTurn = 0.5 * std::numbers::pi;

/// The angle from the road's direction, or from across it, whichever is nearer.
double off_road(double heading_rad) { return std::remainder(heading_rad, kQuarterTurn); }

/// Variance of an L's heading: that of the ranges over the squared lever arms of its points.
double heading_variance(const fit::LShape& shape, std::span<const Vec2> places, double range_sigma_m) {
  double levers_m2 = 0.0;
  for (const fit::LEdge& edge : shape.edges) {
    const double length_m = distance(edge.begin, edge.end);
    if (edge.points.empty() || length_m == 0.0) continue;
    const Vec2 along = (1.0 / length_m) * (edge.end - edge.begin);
    double sum = 0.0;
    double squares = 0.0;
    for (const std::size_t i : edge.points) {
      const double at = dot(places[i], along);
      sum += at;
      squares += at * at;
    }
    levers_m2 += squares - sum * sum / static_cast<double>(edge.points.size());
  }
  return range_sigma_m * range_sigma_m / std::max(levers_m2, 1e-9);
}

/// The L of the points; its heading weighed against the road's direction, where that can be meant.
std::optional<fit::LShape> l_shape_of(std::span<const Vec2> places, const ObjectsConfig& config) {
  constexpr double kDeviations = 3.0;
  const Vec2 sensor;
  auto shape = fit::fit_l_shape(places, sensor, {.criterion = config.criterion});
  if (!shape) return std::nullopt;
  const double own = heading_variance(*shape, places, config.range_sigma_m);
  const double roads = config.road_sigma_rad * config.road_sigma_rad;
  const double off_rad = off_road(shape->heading_rad);
  if (std::fabs(off_rad) > kDeviations * std::sqrt(own + roads)) return shape;
  return fit::l_shape_along(places, sensor, shape->heading_rad - off_rad * own / (own + roads));
}

/// Where the ray to p meets the half of the line through `corner` that runs along `onward`, as a share of its
/// way; infinite where it does not.
double share_at(Vec2 corner, Vec2 onward, Vec2 p) {
  constexpr double kNone = std::numeric_limits<double>::infinity();
  const double across = cross(onward, p);
  if (across == 0.0) return kNone;
  const double on_m = -cross(corner, p) / across;
  const double share = dot(corner + on_m * onward, p) / dot(p, p);
  if (on_m < 0.0 || share <= 0.0) return kNone;
  return share;
}

/// Whether p stands behind the L as the sensor sees it: a return of something else past its end, or one from
/// inside.
bool is_behind(Vec2 p, const fit::LShape& shape) {
  constexpr double kBehind_m = 0.3;
  constexpr double kLong_m = 0.3;  // shorter ones may run anywhere
  double nearest = std::numeric_limits<double>::infinity();
  for (const fit::LEdge& edge : shape.edges) {
    const Vec2 along = edge.end - shape.corner;
    if (norm(along) > kLong_m) nearest = std::min(nearest, share_at(shape.corner, along, p));
  }
  return (1.0 - nearest) * norm(p) > kBehind_m;
}

ObjectShape sign_of(const Outline& outline) {
  if (!outline.face[0] || !outline.face[1]) return ObjectShape::kFace;
  // The edge that runs more along the road is the flank; a right flank has its near face to its left.
  const std::size_t flank = std::fabs(outline.onward[0].x) >= std::fabs(outline.onward[1].x) ? 0 : 1;
  return outline.onward.at(1 - flank).y > 0.0 ? ObjectShape::kJ : ObjectShape::kL;
}

/// The box that the outline is completed to.
Object box_of(const Outline& outline, const Kind& kind) {
  const std::size_t length = kind.length_edge;
  const std::size_t width = 1 - length;
  const Extent along = completed(outline.extent.at(length), kind.length_m);
  const Extent across = completed(outline.extent.at(width), kind.width_m);
  const Vec2 center = outline.corner + 0.5 * (along.low_m + along.high_m) * outline.onward.at(length) +
                      0.5 * (across.low_m + across.high_m) * outline.onward.at(width);
  const Vec2 heading = outline.onward.at(length);
  Object object;
  object.type = kind.type;
  object.shape = sign_of(outline);
  object.center = {center.x, center.y, 0.0};
  object.size = {along.seen_m(), across.seen_m(), 0.0};
  object.yaw_rad = std::atan2(heading.y, heading.x);
  object.confidence = kind.confidence;
  return object;
}

/// What all objects of a scan are found from.
struct View {
  std::span<const LayerPoint> points;
  double height_m = 0.0;  ///< Of the sensor.
  const ObjectsConfig& config;
  const RoadSides& road;
};

std::vector<Vec2> places_of(const View& view, const std::vector<std::size_t>& cluster) {
  std::vector<Vec2> places;
  places.reserve(cluster.size());
  for (const std::size_t i : cluster) places.push_back(view.points[i].place.xy());
  return places;
}

/// The L of the cluster, from which what stands behind it is taken.
std::optional<fit::LShape> fit_cluster(const View& view, std::vector<std::size_t>& cluster) {
  auto shape = l_shape_of(places_of(view, cluster), view.config);
  if (!shape) return std::nullopt;
  const auto behind =
      std::erase_if(cluster, [&](std::size_t i) { return is_behind(view.points[i].place.xy(), *shape); });
  return behind == 0 ? shape : l_shape_of(places_of(view, cluster), view.config);
}

double top_of(const View& view, const std::vector<std::size_t>& cluster) {
  double top_m = 0.0;
  for (const std::size_t i : cluster) top_m = std::max(top_m, view.points[i].place.z);
  return top_m;
}

/// An object before it is known what it is.
struct Thing {
  std::vector<std::size_t> points;
  fit::LShape shape;
  Outline outline;
};

double nearest_m(const View& view, const std::vector<std::size_t>& cluster) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const std::size_t i : cluster) nearest = std::min(nearest, norm(view.points[i].place.xy()));
  return nearest;
}

/// Whether the points are those of one vehicle: they lie on an L of such a size, none behind it.
bool is_one_vehicle(const View& view, const std::vector<std::size_t>& cluster) {
  constexpr double kDeviations = 3.0;
  constexpr double kWidth_m = 2.4;
  const auto shape = l_shape_of(places_of(view, cluster), view.config);
  if (!shape) return false;
  const auto lengths = std::minmax(
      {distance(shape->corner, shape->edges[0].end), distance(shape->corner, shape->edges[1].end)});
  const double rms_m = std::max(shape->edges[0].rms_m, shape->edges[1].rms_m);
  return lengths.second <= view.config.object_length_max_m && lengths.first <= kWidth_m &&
         rms_m <= kDeviations * view.config.range_sigma_m &&
         std::ranges::none_of(cluster,
                              [&](std::size_t i) { return is_behind(view.points[i].place.xy(), *shape); });
}

/// Clusters from left to right; two that stand on either side of a nearer one, which parts them for the
/// sensor, are put together where they can be of one vehicle.
std::vector<std::vector<std::size_t>> seen_past_others(const View& view,
                                                       std::vector<std::vector<std::size_t>> clusters) {
  constexpr double kNearer_m = 0.3;
  for (std::size_t k = 1; k + 1 < clusters.size(); ++k) {
    const double beside_m = std::min(nearest_m(view, clusters[k - 1]), nearest_m(view, clusters[k + 1]));
    if (nearest_m(view, clusters[k]) > beside_m - kNearer_m) continue;
    std::vector<std::size_t> both = clusters[k - 1];
    both.insert(both.end(), clusters[k + 1].begin(), clusters[k + 1].end());
    if (!is_one_vehicle(view, both)) continue;
    clusters[k - 1] = std::move(both);
    clusters.erase(clusters.begin() + static_cast<std::ptrdiff_t>(k + 1));
  }
  return clusters;
}

std::vector<Thing> things_of(const View& view) {
  std::vector<Thing> things;
  for (auto& cluster : seen_past_others(view, object_clusters(view.points, view.config))) {
    auto shape = fit_cluster(view, cluster);
    if (!shape) continue;
    const Beside beside(view.points, cluster, view.height_m, view.config.object_height_min_m);
    const Outline outline = outline_of(*shape, beside, view.config.range_sigma_m);
    things.push_back({std::move(cluster), *std::move(shape), outline});
  }
  return things;
}

std::vector<Row> rows_of(const View& view, std::span<const Thing> things) {
  std::vector<Row> rows;
  for (const Thing& thing : things) {
    const auto row = row_of(thing.outline, kind_of(thing.outline, view.config, view.road));
    if (row) rows.push_back(*row);
  }
  return rows;
}

}  // namespace

std::vector<FoundObject> find_objects(std::span<const LayerPoint> points, double height_m,
                                      const ObjectsConfig& config, const RoadSides& road) {
  const View view{points, height_m, config, road};
  std::vector<Thing> things = things_of(view);
  const std::vector<Row> rows = rows_of(view, things);
  std::vector<FoundObject> objects;
  for (Thing& thing : things) {
    Object object = box_of(thing.outline, kind_of(thing.outline, config, road, rows));
    object.id = static_cast<int>(objects.size());
    object.size.height_m = top_of(view, thing.points);
    object.center.z = 0.5 * object.size.height_m;
    objects.push_back({object, std::move(thing.shape), std::move(thing.points)});
  }
  return objects;
}

Object to_sensor(Object object, const LevelFrame& frame, const Mount& mount) {
  object.center = frame.to_sensor(object.center);
  object.yaw_rad = wrap_pi(object.yaw_rad + mount.forward_rad);
  return object;
}

}  // namespace verge::detect::line_fit
