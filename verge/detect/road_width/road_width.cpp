// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/detect/road_width/road_width.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <ranges>
#include <string>
#include <utility>
#include <vector>

#include <fmt/core.h>

#include "verge/core/field_io.hpp"
#include "verge/detect/road_width/corner_states.hpp"
#include "verge/detect/road_width/corner_tracks.hpp"
#include "verge/detect/road_width/layers.hpp"
#include "verge/detect/road_width/road_line.hpp"

namespace verge::detect {

using namespace road_width;  // NOLINT(google-build-using-namespace): the method's own steps, all of them

/// What is remembered from scan to scan.
struct RoadWidth::State {
  State(const CornerThresholds& thresholds, double widened_m) : corners(thresholds), widening(widened_m) {}

  /// d_v: the way since the scan before; none where a pose is missing.
  std::optional<double> go_on(const Scan& scan) {
    const auto before = std::exchange(
        position, scan.T_world_sensor ? std::optional(scan.T_world_sensor->translation) : std::nullopt);
    if (!position || !before) return std::nullopt;
    const double step_m = norm((*position - *before).xy());
    way_m += step_m;
    return step_m;
  }

  CornerStates corners;
  Widening widening;
  CornerTracks tracks;
  std::optional<Vec3> position{};
  double way_m = 0.0;
};

namespace {

/// A line and the road on it.
struct Road {
  LayerLine line;
  RoadLine road;
};

bool is_printed(const RoadWidthConfig& config) { return config.reading == Reading::kPaper; }

CornerThresholds thresholds_of(const RoadWidthConfig& config) {
  return {.ds_m = config.ds_thres_m,
          .dd_m = config.dd_thres_m,
          .k = static_cast<std::size_t>(config.k_thres),
          .misses = is_printed(config) ? 0 : static_cast<std::size_t>(config.misses)};
}

/// K: what fits the window's width.
std::size_t neighbours_of(const LayerLine& line, const RoadWidthConfig& config) {
  if (config.neighbours > 0) return static_cast<std::size_t>(config.neighbours);
  if (!(line.step_rad > 0.0)) return 1;
  return static_cast<std::size_t>(std::max(1.0, std::round(config.neighbours_rad / line.step_rad)));
}

LineSearch search_of(const LayerLine& line, const RoadWidthConfig& config) {
  LineSearch search{.neighbours = neighbours_of(line, config),
                    .y_thres_m2 = config.y_thres_m2,
                    .x_thres_m2 = config.x_thres_m2,
                    .tangent = line.tangent};
  const bool printed = is_printed(config);
  search.refine = !printed;
  search.bridge = printed ? 0 : static_cast<std::size_t>(config.bridge);
  search.obstacle_m = printed ? std::numeric_limits<double>::infinity() : config.obstacle_m;
  return search;
}

/// Steps 1 to 7 on each line, first to last.
std::vector<Road> road_lines(std::vector<LayerLine> lines, const RoadWidthConfig& config) {
  std::vector<Road> roads;
  for (LayerLine& line : lines) {
    const auto road = find_road_line(line.points, line.middle, search_of(line, config));
    if (road) roads.push_back({std::move(line), *road});
  }
  return roads;
}

/// X_max: the last line sees no farther to the side, and is not to be compared with what it cannot see.
double reach_of(const std::vector<Road>& roads, const RoadWidthConfig& config) {
  const LayerLine& last = roads.back().line;
  return std::min(config.reach_m, last.points[last.middle].y * std::tan(config.side_rad));
}

FirstLine first_line(const Road& first, double reach_m) {
  const std::vector<PicturePoint>& points = first.line.points;
  return {.length_m = road_length_m(points, first.road, reach_m),
          .left_m = std::min(reach_m, -points[first.road.left.edge].x),
          .right_m = std::min(reach_m, points[first.road.right.edge].x),
          .ahead_m = points[first.line.middle].y};
}

double last_length_m(const std::vector<Road>& roads, double reach_m) {
  return road_length_m(roads.back().line.points, roads.back().road, reach_m);
}

/// Whether there are lines to compare, and the vehicle is on the road (hypothesis 1; not tested as printed).
bool are_comparable(const std::vector<Road>& roads, const RoadWidthConfig& config) {
  return roads.size() > 1 && (is_printed(config) || roads.front().road.middle_is_road);
}

/// h: in the paper's reading a number of scans, else a way, so that a slow vehicle looks farther back.
std::size_t lag_of(std::optional<double> step_m, const RoadWidthConfig& config) {
  if (is_printed(config) || !step_m) return static_cast<std::size_t>(config.lag);
  constexpr double kMost = 20.0;
  const double least = static_cast<double>(config.k_thres) + 2.0;
  if (*step_m <= 0.0) return static_cast<std::size_t>(kMost);
  return static_cast<std::size_t>(
      std::clamp(std::round(config.lag_m / *step_m), least, std::max(least, kMost)));
}

/// The edges of a side, nearest line first, where two lines or more have one.
std::optional<Boundary> boundary_of(const std::vector<Road>& roads, Side side, const LevelFrame& frame) {
  Boundary boundary;
  boundary.side = side;
  boundary.kind = BoundaryKind::kCurb;
  boundary.model = Model::kPolyline;
  for (const Road& road : std::views::reverse(roads)) {
    const RoadEnd& end = side == Side::kLeft ? road.road.left : road.road.right;
    if (end.kind == LineEnd::kEdge) boundary.points.push_back(frame.to_sensor(road.line.level[end.edge]));
  }
  if (boundary.points.size() < 2) return std::nullopt;
  boundary.confidence = static_cast<double>(boundary.points.size()) / static_cast<double>(roads.size());
  return boundary;
}

void record(Trace& trace, const std::vector<Road>& roads, double reach_m, const CornerStep& step,
            std::size_t lag, const LevelFrame& frame) {
  Trace::Values lengths{"L", {}};
  Trace::Points edges{"edges", {}, {}};
  for (std::size_t i = 0; i < roads.size(); ++i) {
    Trace::Points points{fmt::format("line {}", i + 1), {}, {}};
    for (const Vec3& p : roads[i].line.level) points.points.push_back(frame.to_sensor(p));
    trace.points.push_back(std::move(points));
    lengths.values.push_back(road_length_m(roads[i].line.points, roads[i].road, reach_m));
    for (const RoadEnd& end : {roads[i].road.left, roads[i].road.right}) {
      if (end.kind == LineEnd::kOpen) continue;
      edges.points.push_back(frame.to_sensor(roads[i].line.level[end.edge]));
      edges.group.push_back(static_cast<int>(i));
    }
  }
  trace.points.push_back(std::move(edges));
  trace.values.push_back(std::move(lengths));
  trace.values.push_back({"K", {static_cast<double>(step.k)}});
  trace.values.push_back({"CCS", {step.candidate ? 1.0 : 0.0}});
  trace.values.push_back({"h", {static_cast<double>(lag)}});
}

Mount mount_of(const Scan& scan) {
  Mount mount = scan.mount ? *scan.mount : estimate_mount(scan).mount;
  mount.forward_rad = 0.0;  // hypothesis 1: the vehicle keeps parallel with the road
  return mount;
}

/// `corners` are in the level frame.
Scene scene_of(const Scan& scan, const std::vector<Road>& roads, std::vector<Corner> corners,
               const LevelFrame& frame) {
  Scene scene;
  scene.frame = scan.frame;
  scene.stamp_ns = scan.stamp_ns;
  scene.frame_id = scan.frame_id;
  for (const Side side : {Side::kLeft, Side::kRight}) {
    auto boundary = boundary_of(roads, side, frame);
    if (!boundary) continue;
    boundary->id = static_cast<int>(scene.boundaries.size());
    scene.boundaries.push_back(*std::move(boundary));
  }
  for (Corner& corner : corners)
    corner.position = frame.to_sensor({corner.position.x, corner.position.y, 0.0}).xy();
  scene.corners = std::move(corners);
  return scene;
}

}  // namespace

RoadWidth::RoadWidth() : RoadWidth(Config{}) {}
RoadWidth::RoadWidth(const Config& config) : config_(config) {
  check_fields(config_);
  state_ = std::make_unique<State>(thresholds_of(config_), config_.widened_m);
}
RoadWidth::~RoadWidth() = default;

Scene RoadWidth::process(const Scan& scan, Trace* trace) {
  State& state = *state_;
  const Mount mount = mount_of(scan);
  const LevelFrame frame(mount);
  const std::optional<double> step_m = state.go_on(scan);                                    // d_v
  const auto roads = road_lines(four_lines(scan, frame, mount.height_m, config_), config_);  // Steps 1 to 7
  if (are_comparable(roads, config_)) {
    const double reach_m = reach_of(roads, config_);
    const FirstLine first = first_line(roads.front(), reach_m);
    const std::size_t lag = lag_of(step_m, config_);  // h
    const CornerStep step = state.corners.step({first.length_m, last_length_m(roads, reach_m)}, lag);
    state.widening.see(first, state.way_m);
    if (step.found) {  // corner Step 7
      state.tracks.add(first, state.widening.straight(), state.widening.began_m().value_or(state.way_m),
                       state.way_m, step_m.value_or(0.0), config_.ds_thres_m);
    }
    if (trace != nullptr) record(*trace, roads, reach_m, step, lag, frame);
  }
  return scene_of(scan, roads, state.tracks.ahead(state.way_m), frame);
}

}  // namespace verge::detect
