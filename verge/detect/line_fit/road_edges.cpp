// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/detect/line_fit/road_edges.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "verge/core/statistics.hpp"
#include "verge/detect/scan_scene.hpp"

namespace verge::detect::line_fit {
namespace {

bool runs_along_road(const Edge& edge, double along_road_max_rad) {
  const Vec2 chord = place_on(edge.curve, edge.to_m) - place_on(edge.curve, edge.from_m);
  return std::fabs(chord.y) <= std::tan(along_road_max_rad) * std::fabs(chord.x);
}

/// Foot of the kerb's face: its lowest returns, but for one that strayed.
double foot_m(const Edge& edge, std::span<const LayerPoint> points) {
  constexpr double kLowest = 10.0;  // per cent
  std::vector<double> heights;
  for (const std::size_t i : edge.points) heights.push_back(points[i].place.z);
  return percentile(heights, kLowest).value_or(0.0);
}

/// Stations of the edge's points, ascending.
std::vector<double> stations_of(const Edge& edge, std::span<const LayerPoint> points) {
  std::vector<double> stations;
  for (const std::size_t i : edge.points) stations.push_back(station_on(edge.curve, points[i].place.xy()));
  std::ranges::sort(stations);
  return stations;
}

double nearest_m(const std::vector<double>& stations, double station_m) {
  const auto behind = std::ranges::lower_bound(stations, station_m);
  const double ahead =
      behind != stations.end() ? *behind - station_m : std::numeric_limits<double>::infinity();
  return behind != stations.begin() ? std::min(ahead, station_m - *(behind - 1)) : ahead;
}

/// The more returns, the surer.
double confidence_of(const Edge& edge) {
  constexpr double kHalf = 5.0;
  const auto returns = static_cast<double>(edge.points.size());
  return returns / (returns + kHalf);
}

/// y where the edge passes x; none beyond its ends.
std::optional<double> lateral_at(const Edge& edge, double x) {
  const Vec2 from = place_on(edge.curve, edge.from_m);
  const Vec2 to = place_on(edge.curve, edge.to_m);
  if (x < from.x || x > to.x || from.x >= to.x) return std::nullopt;
  return place_on(edge.curve, std::lerp(edge.from_m, edge.to_m, (x - from.x) / (to.x - from.x))).y;
}

/// P2-26.
std::optional<RoadSurface> widths_of(const RoadEdges& edges, double reach_m) {
  constexpr double kStep_m = 5.0;
  RoadSurface road;
  if (!edges.left || !edges.right) return std::nullopt;
  for (int i = 0; i * kStep_m <= reach_m; ++i) {
    const auto left = lateral_at(*edges.left, i * kStep_m);
    const auto right = lateral_at(*edges.right, i * kStep_m);
    if (left && right) road.width_m.push_back({i * kStep_m, *left - *right});
  }
  return road.width_m.empty() ? std::nullopt : std::optional(road);
}

}  // namespace

RoadEdges road_edges(const std::vector<Edge>& edges, const LineFitConfig& config) {
  RoadEdges road;
  for (const Edge& edge : edges) {
    if (!runs_along_road(edge, config.along_road_max_rad)) continue;
    const double middle_m = place_on(edge.curve, 0.5 * (edge.from_m + edge.to_m)).y;
    auto& side = middle_m > 0.0 ? road.left : road.right;
    if (!side || edge.length_m() > side->length_m()) side = edge;
  }
  return road;
}

Boundary boundary_of(const Edge& edge, Side side, std::span<const LayerPoint> points,
                     const LineFitConfig& config) {
  constexpr double kStep_m = 0.5;
  Boundary boundary;
  boundary.side = side;
  boundary.model = std::holds_alternative<fit::Line>(edge.curve) ? Model::kLine : Model::kPolyline;
  boundary.kind = config.grouping == EdgeGrouping::kKerb && !config.is_printed() ? BoundaryKind::kCurb
                                                                                 : BoundaryKind::kUnknown;
  boundary.confidence = confidence_of(edge);
  const double z = foot_m(edge, points);
  const std::vector<double> stations = stations_of(edge, points);
  const auto steps = static_cast<std::size_t>(std::ceil(std::max(edge.length_m(), 0.1) / kStep_m));
  for (std::size_t i = 0; i <= steps; ++i) {
    const double station_m =
        std::lerp(edge.from_m, edge.to_m, static_cast<double>(i) / static_cast<double>(steps));
    const Vec2 place = place_on(edge.curve, station_m);
    boundary.points.push_back({place.x, place.y, z});
    boundary.state.push_back(nearest_m(stations, station_m) <= config.bridged_m ? PointState::kVisible
                                                                                : PointState::kBridged);
  }
  return boundary;
}

Scene scene_of(const Scan& scan, std::span<const LayerPoint> points, const RoadEdges& edges,
               std::span<const FoundObject> found, const LevelFrame& frame, const Mount& mount,
               const LineFitConfig& config) {
  Scene scene = scene_about(scan);
  for (const Side side : {Side::kLeft, Side::kRight}) {
    const auto& edge = side == Side::kLeft ? edges.left : edges.right;
    if (!edge) continue;
    add_boundary(scene, boundary_of(*edge, side, points, config), frame);
  }
  for (const FoundObject& each : found) scene.objects.push_back(to_sensor(each.object, frame, mount));
  scene.road = widths_of(edges, config.points.range_max_m);
  return scene;
}

}  // namespace verge::detect::line_fit
