// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/sim/road_mesh.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace verge::sim {
namespace {

constexpr double kStraightStep_m = 10.0;
constexpr double kGroundMargin_m = 150.0;
constexpr std::array kSides = {1.0, -1.0};  // left, right: the sign of the lateral coordinate

double step_of(const Piece& piece, double reach) {
  if (piece.curvature_1pm == 0.0) return kStraightStep_m;
  const double curvature = std::fabs(piece.curvature_1pm);
  // Sagitta of an arc of angle t and radius r: r t^2 / 8, greatest at the outer edge.
  const double outer_radius = 1.0 / curvature + reach;
  return std::sqrt(8.0 * kChordErrorMax_m / outer_radius) / curvature;
}

// A vertex of the section on one side of the road; sign = +1 left, -1 right.
Vec3 place(const Station& station, const SectionPoint& vertex, double sign) {
  const double lateral = sign * vertex.lateral_m;
  return {station.position.x - lateral * std::sin(station.heading_rad),
          station.position.y + lateral * std::cos(station.heading_rad), vertex.height_m};
}

void add_strip(World& world, const std::vector<SectionPoint>& section, const Station& from, const Station& to,
               double sign) {
  for (std::size_t i = 0; i + 1 < section.size(); ++i) {
    add_quad(world, place(from, section[i], sign), place(to, section[i], sign),
             place(to, section[i + 1], sign), place(from, section[i + 1], sign), section[i].outward);
  }
}

// Closes the end of the strip down to the ground, so that no ray slips under the road.
void add_end(World& world, const std::vector<SectionPoint>& section, const Station& station, double sign) {
  const double ground = section.back().height_m;
  for (std::size_t i = 0; i + 1 < section.size(); ++i) {
    const Vec3 a = place(station, section[i], sign);
    const Vec3 b = place(station, section[i + 1], sign);
    add_quad(world, {a.x, a.y, ground}, {b.x, b.y, ground}, b, a, Surface::kGround);
  }
}

void add_houses(World& world, const Road& road, const Houses& houses) {
  const double lateral =
      0.5 * road.config().width_m + road.config().sidewalk_width_m + houses.setback_m + 0.5 * houses.depth_m;
  const double ground = road.section().back().height_m;
  const double pitch = houses.length_m + houses.gap_m;
  const double room = road.length_m() - houses.length_m;
  const std::size_t count = room < 0.0 ? 0 : static_cast<std::size_t>(room / pitch) + 1;
  for (std::size_t i = 0; i < count; ++i) {
    const double station = 0.5 * houses.length_m + pitch * static_cast<double>(i);
    for (const double sign : kSides) {
      Vec3 base = road.point(station, sign * lateral);
      base.z = ground;
      add_box(
          world,
          {base, {houses.length_m, houses.depth_m, houses.height_m - ground}, road.at(station).heading_rad},
          Surface::kWall);
    }
  }
}

void add_ground_around(World& world, const Road& road, const std::vector<double>& stations) {
  Vec2 low;
  Vec2 high;
  for (const double s : stations) {
    const Vec2 p = road.at(s).position;
    low = {std::min(low.x, p.x), std::min(low.y, p.y)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y)};
  }
  const Vec2 center = 0.5 * (low + high);
  const double half = 0.5 * std::max(high.x - low.x, high.y - low.y) + kGroundMargin_m;
  add_ground(world, {center.x, center.y, road.section().back().height_m}, half, Surface::kGround);
}

}  // namespace

std::vector<double> mesh_stations(const Road& road) {
  const double reach = road.section().back().lateral_m;
  std::vector<double> stations = {0.0};
  for (const Piece& piece : road.config().pieces) {
    const double begin = stations.back();
    const auto steps = static_cast<std::size_t>(std::ceil(piece.length_m / step_of(piece, reach)));
    for (std::size_t i = 1; i <= steps; ++i) {
      const double share = static_cast<double>(i) / static_cast<double>(steps);
      stations.push_back(begin + piece.length_m * share);
    }
  }
  return stations;
}

World make_world(const Road& road) {
  World world;
  const std::vector<double> stations = mesh_stations(road);
  for (const double sign : kSides) {
    for (std::size_t i = 0; i + 1 < stations.size(); ++i) {
      add_strip(world, road.section(), road.at(stations[i]), road.at(stations[i + 1]), sign);
    }
    add_end(world, road.section(), road.at(stations.front()), sign);
    add_end(world, road.section(), road.at(stations.back()), sign);
  }
  if (road.config().houses) add_houses(world, road, *road.config().houses);
  add_ground_around(world, road, stations);
  return world;
}

}  // namespace verge::sim
