// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/detect/road_width/road_width.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <ranges>
#include <string>
#include <utility>
#include <vector>

#include <fmt/core.h>

#include "verge/core/field_io.hpp"
#include "verge/detect/road_width/corner_tracks.hpp"
#include "verge/detect/road_width/kerb_corners.hpp"
#include "verge/detect/road_width/layers.hpp"
#include "verge/detect/road_width/road_lines.hpp"
#include "verge/detect/road_width/width_corners.hpp"
#include "verge/detect/scan_scene.hpp"

namespace verge::detect {

using namespace road_width;  // NOLINT(google-build-using-namespace): the method's own steps, all of them

/// What is remembered from scan to scan.
struct RoadWidth::State {
  explicit State(const RoadWidthConfig& config) : width_corners(config), kerb_corners(config) {}

  /// d_v: the way since the last scan that was on the way; none where a pose is missing. Less than 5 cm are
  /// none: poses tremble where a vehicle stands.
  std::optional<double> go_on(const Scan& scan) {
    constexpr double kStanding_m = 0.05;
    if (!scan.T_world_sensor) position.reset();
    if (!scan.T_world_sensor) return std::nullopt;
    const Vec2 here = scan.T_world_sensor->translation.xy();
    const double step_m = position ? distance(here, *position) : 0.0;
    if (position && step_m < kStanding_m) return 0.0;
    const bool is_first = !position;
    position = here;
    way_m += step_m;
    turn_to(here);
    return is_first ? std::nullopt : std::optional(step_m);
  }

  /// The course, from one place to another a metre on.
  void turn_to(Vec2 place) {
    constexpr double kFar_m = 1.0;
    if (!turned_at) turned_at = place;
    const double far_m = distance(place, *turned_at);
    if (far_m < kFar_m) return;
    course = (1.0 / far_m) * (place - *turned_at);
    turned_at = place;
  }

  [[nodiscard]] Whereabouts whereabouts(const Pose& T_world_level, std::optional<double> step_m) const {
    const Vec2 heading = rotate(T_world_level.rotation, {1.0, 0.0, 0.0}).xy();
    return {T_world_level, course.value_or((1.0 / norm(heading)) * heading), way_m, step_m.value_or(0.0)};
  }

  WidthCorners width_corners;
  KerbCorners kerb_corners;
  CornerTracks tracks;
  std::optional<Vec2> position{};  // where the way was counted to
  std::optional<Vec2> turned_at{};
  std::optional<Vec2> course{};
  double way_m = 0.0;
};

namespace {

/// Whether there are lines to compare, and the vehicle is on the road (hypothesis 1; not tested as printed).
bool are_comparable(const std::vector<Road>& roads, const RoadWidthConfig& config) {
  return roads.size() > 1 && (config.is_printed() || roads.front().road.middle_is_road);
}

/// The edges of a side in the level frame, nearest line first, where two lines or more have one.
std::optional<Boundary> boundary_of(const std::vector<Road>& roads, Side side) {
  Boundary boundary;
  boundary.side = side;
  boundary.kind = BoundaryKind::kCurb;
  boundary.model = Model::kPolyline;
  const bool left = side == Side::kLeft;
  for (const Road& road : std::views::reverse(roads)) {
    if ((left ? road.road.left : road.road.right).kind == LineEnd::kEdge)
      boundary.points.push_back(left ? road.left : road.right);
  }
  if (boundary.points.size() < 2) return std::nullopt;
  boundary.confidence = static_cast<double>(boundary.points.size()) / static_cast<double>(roads.size());
  return boundary;
}

void record_lines(Trace& trace, const std::vector<Road>& roads, double reach_m, const LevelFrame& frame) {
  Trace::Values lengths{"L", {}};
  Trace::Values middle{"middle is road", {}};
  Trace::Points edges{"edges", {}, {}};
  for (std::size_t i = 0; i < roads.size(); ++i) {
    Trace::Points points{fmt::format("line {}", i + 1), {}, {}};
    for (const Vec3& p : roads[i].line.level) points.points.push_back(frame.to_sensor(p));
    points.group.assign(points.points.size(), static_cast<int>(i));
    trace.points.push_back(std::move(points));
    middle.values.push_back(roads[i].road.middle_is_road ? 1.0 : 0.0);
    lengths.values.push_back(length_m(roads[i], reach_m));
    const auto add_edge = [&](const RoadEnd& end, Vec3 place) {
      if (end.kind == LineEnd::kOpen) return;
      edges.points.push_back(frame.to_sensor(place));
      edges.group.push_back(static_cast<int>(i));
    };
    add_edge(roads[i].road.left, roads[i].left);
    add_edge(roads[i].road.right, roads[i].right);
  }
  trace.points.push_back(std::move(edges));
  trace.values.push_back(std::move(lengths));
  trace.values.push_back(std::move(middle));
}

void record_step(Trace& trace, const WidthStep& done, const RoadWidthConfig& config) {
  const CornerStep& step = done.step;
  trace.values.push_back({"first comparison", {step.first_m, config.dd_thres_m}});
  trace.values.push_back({"second comparison", {step.second_m, config.ds_thres_m}});
  trace.values.push_back({"K", {static_cast<double>(step.k), static_cast<double>(config.k_thres)}});
  trace.values.push_back({"CCS", {step.candidate ? 1.0 : 0.0}});
  trace.values.push_back({"h", {static_cast<double>(done.lag)}});
}

/// T_world_level of T_world_sensor.
Pose level_pose(const Pose& T_world_sensor, const Mount& mount) {
  const Pose T_level_sensor{from_yaw_pitch_roll(-mount.forward_rad, mount.pitch_rad, mount.roll_rad),
                            {0.0, 0.0, mount.height_m}};
  return T_world_sensor * inverse(T_level_sensor);
}

/// `corners` are in the level frame.
Scene scene_of(const Scan& scan, const std::vector<Road>& roads, std::vector<Corner> corners,
               const LevelFrame& frame) {
  Scene scene = scene_about(scan);
  for (const Side side : {Side::kLeft, Side::kRight}) {
    if (auto boundary = boundary_of(roads, side)) add_boundary(scene, *std::move(boundary), frame);
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
  state_ = std::make_unique<State>(config_);
}
RoadWidth::~RoadWidth() = default;

Scene RoadWidth::process(const Scan& scan, Trace* trace) {
  State& state = *state_;
  const Mount mount = scan.mount ? *scan.mount : estimate_mount(scan).mount;
  const LevelFrame frame(mount);
  const std::optional<double> step_m = state.go_on(scan);                           // d_v
  const auto roads = road_lines(four_lines(scan, frame, mount, config_), config_);  // Steps 1 to 7
  if (trace != nullptr && !roads.empty()) record_lines(*trace, roads, reach_m(roads, config_), frame);
  std::optional<Pose> T_world_level;
  if (scan.T_world_sensor) T_world_level = level_pose(*scan.T_world_sensor, mount);
  if (config_.reading == CornerReading::kCombined && T_world_level) {
    if (!roads.empty() && step_m != 0.0)  // a standing vehicle sees nothing new
      state.kerb_corners.see(roads, state.whereabouts(*T_world_level, step_m), state.tracks);
  } else if (are_comparable(roads, config_)) {
    const WidthStep step = state.width_corners.see(roads, state.way_m, step_m, state.tracks);
    if (trace != nullptr) record_step(*trace, step, config_);
  }
  if (!T_world_level) state.tracks.forget_left();
  return scene_of(scan, roads, state.tracks.at(state.way_m, T_world_level), frame);
}

}  // namespace verge::detect
