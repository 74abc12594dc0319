// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/sim/mouth.hpp"

#include <cmath>
#include <optional>
#include <stdexcept>

#include <fmt/format.h>

#include "verge/core/angle.hpp"

namespace verge::sim {
namespace {

/// An arc that touches an edge of two roads.
struct Return {
  double road_m = 0.0;    // station where it touches the road's edge
  double branch_m = 0.0;  // station where it touches the branch's
  Vec2 center;
};

struct TwoEdges {
  const Road& road;
  RoadSide road_side;
  const Road& branch;
  RoadSide branch_side;
  double radius;

  [[nodiscard]] Vec2 center_by_road(double s) const {
    const EdgePoint p = road.edge_point(road_side, s);
    return p.position + radius * p.outward;
  }
  [[nodiscard]] Vec2 center_by_branch(double t) const {
    const EdgePoint p = branch.edge_point(branch_side, t);
    return p.position + radius * p.outward;
  }
};

// The centre is where the two edges, moved outward by the radius, cross.
std::optional<Return> touch(const TwoEdges& edges, double s, double t) {
  constexpr double kStep = 1e-5;
  for (int i = 0; i < 60; ++i) {
    const Vec2 center = edges.center_by_branch(t);
    const Vec2 miss = edges.center_by_road(s) - center;
    if (norm(miss) < 1e-9) return Return{s, t, center};
    const Vec2 ds = (0.5 / kStep) * (edges.center_by_road(s + kStep) - edges.center_by_road(s - kStep));
    const Vec2 dt = (-0.5 / kStep) * (edges.center_by_branch(t + kStep) - edges.center_by_branch(t - kStep));
    const double det = cross(ds, dt);
    if (std::fabs(det) < 1e-9) return std::nullopt;
    s -= cross(miss, dt) / det;
    t -= cross(ds, miss) / det;
  }
  return std::nullopt;
}

// Where the arc would lie between straight roads; `ahead` = +1 for the one at the greater station.
std::optional<Return> make_return(const Road& road, const Road& branch, double ahead) {
  const RoadConfig& config = branch.config();
  const RoadSide side = config.side;
  const bool by_left = (ahead > 0.0) == (side == RoadSide::kRight);
  const RoadSide branch_side = by_left ? RoadSide::kLeft : RoadSide::kRight;
  const double turn = deg_to_rad(config.angle_deg);
  const double a = road.edge_offset(side, config.at_m) + config.radius_m;
  const double b = branch.edge_offset(branch_side, 0.0) + config.radius_m;
  const double s = config.at_m + (a * std::cos(turn) + ahead * b) / std::sin(turn);
  const double t = (a + ahead * b * std::cos(turn)) / std::sin(turn);
  return touch({road, side, branch, branch_side, config.radius_m}, s, t);
}

Mouth make_mouth(const std::vector<Road>& roads, std::size_t index) {
  const Road& branch = roads[index];
  const auto parent = static_cast<std::size_t>(branch.config().branch_of - 1);
  const Road& road = roads[parent];
  const auto begin = make_return(road, branch, -1.0);
  const auto end = make_return(road, branch, 1.0);
  const auto fits = [&](const std::optional<Return>& arc) {
    return arc && arc->branch_m > 0.0 && arc->branch_m < branch.length_m() && arc->road_m > 0.0 &&
           arc->road_m < road.length_m();
  };
  if (!fits(begin) || !fits(end) || begin->road_m >= end->road_m) {
    throw std::invalid_argument(
        fmt::format("road {}: its kerb returns of {} m do not fit where it branches off", index + 1,
                    branch.config().radius_m));
  }
  const RoadSide side = branch.config().side;
  return {.branch = index,
          .road = parent,
          .side = side,
          .begin_m = begin->road_m,
          .end_m = end->road_m,
          .begin = road.edge_point(side, begin->road_m).position,
          .end = road.edge_point(side, end->road_m).position,
          .begin_branch_m = begin->branch_m,
          .end_branch_m = end->branch_m,
          .begin_center = begin->center,
          .end_center = end->center};
}

}  // namespace

std::vector<Mouth> make_mouths(const std::vector<Road>& roads) {
  std::vector<Mouth> mouths;
  for (std::size_t i = 0; i < roads.size(); ++i) {
    if (roads[i].config().branch_of != 0) mouths.push_back(make_mouth(roads, i));
  }
  return mouths;
}

}  // namespace verge::sim
