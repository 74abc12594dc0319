// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/detect/line_fit/line_fit.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/core.h>

#include "verge/core/field_io.hpp"
#include "verge/detect/line_fit/edge_curve.hpp"
#include "verge/detect/line_fit/groups.hpp"
#include "verge/detect/line_fit/hough_lines.hpp"
#include "verge/detect/line_fit/recorder.hpp"
#include "verge/detect/line_fit/road_edges.hpp"
#include "verge/fit/path.hpp"

namespace verge::detect {

using namespace line_fit;  // NOLINT(google-build-using-namespace): the method's own steps, all of them

namespace {

constexpr std::size_t kThirdLayer = 2;  // IV: "we will consider scan level number 2"

/// IV: the one layer that lines go by, or all.
std::vector<LayerPoint> chosen_layer(std::vector<LayerPoint> points, const LineFitConfig& config) {
  if (!config.is_printed() && config.layer < 0) return points;
  const std::size_t layer = config.is_printed() ? kThirdLayer : static_cast<std::size_t>(config.layer);
  std::erase_if(points, [&](const LayerPoint& p) { return p.layer != layer; });
  return points;
}

/// III: a curve through each group, or the Hough lines of each.
std::vector<Edge> edges_by(EdgeEstimator estimator, const std::vector<Vec2>& places, const Groups& groups,
                           const LineFitConfig& config, Recorder& record) {
  std::vector<Edge> edges;
  for (const auto& group : groups.points) {
    if (estimator == EdgeEstimator::kHough) {
      HoughSteps steps = hough_lines(places, group, config);
      record.hough(steps);
      for (Edge& edge : steps.lines) edges.push_back(std::move(edge));
    } else if (auto curve = estimate(fit::gather(places, group), estimator, config)) {
      edges.push_back(edge_of(*std::move(curve), group, places));
    }
  }
  return edges;
}

/// What every estimator makes of the same groups, to be looked at beside each other (Fig. 16 to 18).
void record_all(const std::vector<Vec2>& places, const Groups& groups, const LineFitConfig& config,
                Recorder& record) {
  if (!record.is_on()) return;
  for (std::size_t i = 0; i < enum_names<EdgeEstimator>.size(); ++i) {
    const std::vector<Edge> edges = edges_by(static_cast<EdgeEstimator>(i), places, groups, config, record);
    for (std::size_t k = 0; k < edges.size(); ++k)
      record.edge(fmt::format("{} {}", enum_names<EdgeEstimator>.at(i), k), edges[k]);
  }
}

/// Where the edges lie beside the objects' middle distance, for what stands beyond them.
RoadSides sides_of(const RoadEdges& edges) {
  constexpr double kAhead_m = 10.0;
  const auto lateral = [](const std::optional<Edge>& edge) -> std::optional<double> {
    if (!edge) return std::nullopt;
    return place_on(edge->curve, station_on(edge->curve, {kAhead_m, 0.0})).y;
  };
  return {lateral(edges.left), lateral(edges.right)};
}

std::vector<Object> objects_in(const std::vector<FoundObject>& found) {
  std::vector<Object> objects;
  for (const FoundObject& each : found) objects.push_back(each.object);
  return objects;
}

}  // namespace

LineFit::LineFit(const Config& config) : config_(config) { check_fields(config_); }

Scene LineFit::process(const Scan& scan, Trace* trace) {
  const Mount mount = scan.mount ? *scan.mount : estimate_mount(scan).mount;
  const LevelFrame frame(mount);
  Recorder record(trace, frame);
  Recorder silent(nullptr, frame);  // what every estimator makes of it is recorded at the end

  const auto gated = layer_points(scan, frame, mount, config_.points);  // Fig. 6
  const bool printed = config_.is_printed();
  auto found = printed ? std::vector<FoundObject>{}
                       : find_objects(gated, mount.height_m, config_.objects);  // III-C: "-", "J", "L"
  const auto points = chosen_layer(gated, config_);                             // IV
  const std::vector<Vec2> places = places_of(points);
  const EdgeGrouping grouping = printed ? EdgeGrouping::kNone : config_.grouping;
  const auto groups = groups_of(points, objects_in(found), grouping, config_);      // IV
  const auto lines = edges_by(config_.estimator, places, groups, config_, silent);  // III
  const RoadEdges edges = road_edges(lines, config_);                               // V
  if (!printed) found = find_objects(gated, mount.height_m, config_.objects, sides_of(edges));

  record.points("gate", gated);
  record.points("layer", points);
  record.groups("groups", points, printed ? kmeans_groups(points, config_) : groups);
  record_all(places, groups, config_, record);
  record.objects(found);
  return scene_of(scan, points, edges, found, frame, mount, config_);
}

}  // namespace verge::detect
