// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/sim/truth.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

namespace verge::sim {
namespace {

using Line = std::vector<Vec3>;

// The runs of consecutive points within `radius` of the origin in the plane.
std::vector<Line> clip(const Line& line, double radius) {
  std::vector<Line> runs;
  bool inside = false;
  for (const Vec3& p : line) {
    const bool was_inside = std::exchange(inside, norm(p.xy()) <= radius);
    if (!inside) continue;
    if (!was_inside) runs.emplace_back();
    runs.back().push_back(p);
  }
  std::erase_if(runs, [](const Line& run) { return run.size() < 2; });
  return runs;
}

bool is_straight(const Line& line) {
  constexpr double kTolerance_m = 1e-6;
  const Vec2 chord = (line.back() - line.front()).xy();
  return std::all_of(line.begin(), line.end(), [&](const Vec3& p) {
    return std::fabs(cross(chord, (p - line.front()).xy())) <= kTolerance_m * norm(chord);
  });
}

Boundary boundary_of(Line line, Side side, double curb_height_m) {
  Boundary boundary;
  boundary.side = side;
  boundary.model = is_straight(line) ? Model::kLine : Model::kPolyline;
  boundary.kind = curb_height_m > 0.0 ? BoundaryKind::kCurb : BoundaryKind::kFlush;
  boundary.confidence = 1.0;
  boundary.height_m.assign(line.size(), curb_height_m);
  boundary.points = std::move(line);
  return boundary;
}

}  // namespace

CurbFeet curb_feet(const Road& road) {
  return {.left = road.curb_foot(Side::kLeft),
          .right = road.curb_foot(Side::kRight),
          .height_m = road.config().curb_height_m};
}

Scene truth_scene(const CurbFeet& feet, const Pose& T_world_sensor, double radius_m) {
  const Pose T_sensor_world = inverse(T_world_sensor);
  Scene scene;
  scene.method = "truth";
  for (const Side side : std::array{Side::kLeft, Side::kRight}) {
    Line foot = side == Side::kLeft ? feet.left : feet.right;
    for (Vec3& p : foot) p = T_sensor_world * p;
    for (Line& run : clip(foot, radius_m)) {
      scene.boundaries.push_back(boundary_of(std::move(run), side, feet.height_m));
      scene.boundaries.back().id = static_cast<int>(scene.boundaries.size());
    }
  }
  return scene;
}

}  // namespace verge::sim
