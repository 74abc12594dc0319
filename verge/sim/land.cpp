// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/sim/land.hpp"

#include <algorithm>

#include "verge/sim/land_mesh.hpp"

namespace verge::sim {
namespace {

constexpr double kPlainBelowEdge_m = 0.1;
constexpr double kGrassGrowsWithin_m = 0.3;
constexpr double kAllOfIsland_m = 100.0;  // an island is paved all over

}  // namespace

Land::Land(const std::vector<RoadConfig>& roads, const GroundConfig& ground)
    : roads_(make_roads(roads)),
      ground_(ground, roads_),
      outline_(make_outline(roads_, outline_step(ground))),
      index_(outline_) {
  double lowest = 0.0;
  for (const OutlineLoop& loop : outline_.loops) {
    auto& feet = feet_.emplace_back();
    auto& below_crown = below_crown_.emplace_back();
    for (const OutlineVertex& v : loop.vertices) {
      below_crown.push_back(ground_.below_crown(v.position));
      feet.push_back({v.position.x, v.position.y, ground_.land(v.position) - below_crown.back()});
      lowest = std::max(lowest, below_crown.back());
    }
  }
  plain_m_ = -lowest - kPlainBelowEdge_m;
}

Section Land::section(std::size_t loop, std::size_t vertex, double share) const {
  const auto& vertices = outline_.loops[loop].vertices;
  const OutlineVertex& from = vertices[vertex];
  const std::size_t next = (vertex + 1) % vertices.size();
  const RoadConfig& road = roads_[from.road].config();
  const auto blend = [share](double a, double b) { return a + share * (b - a); };
  return {.edge = from.edge,
          .is_end = from.part == Part::kEnd,
          .step_m = blend(from.step_m, vertices[next].step_m),
          .face = road.face,
          .sidewalk_m = from.part == Part::kIsland ? kAllOfIsland_m : road.sidewalk_m,
          .slope = ground_.config().crown,
          .edge_m = -blend(below_crown_[loop][vertex], below_crown_[loop][next]),
          .plain_m = plain_m_};
}

double Land::height(Vec2 p) const {
  const NearestEdge near = index_.nearest(p);
  if (near.outside_m <= 0.0) return ground_.road(p);
  const Section beside = section(near.loop, near.vertex, near.share);
  double height = ground_.land(p) + height_at(beside, near.outside_m);
  const bool grass = !beside.is_end && (beside.edge == Edge::kGrass || beside.edge == Edge::kDitch);
  if (grass) height += std::min(1.0, near.outside_m / kGrassGrowsWithin_m) * ground_.grass(p);
  return height;
}

Surface Land::surface(Vec2 p) const {
  const NearestEdge near = index_.nearest(p);
  if (near.outside_m <= 0.0) return Surface::kRoad;
  return surface_at(section(near.loop, near.vertex, near.share), near.outside_m);
}

Vec3 Land::foot(std::size_t loop, std::size_t vertex) const { return feet_[loop][vertex]; }

World Land::mesh() const { return mesh_of(*this); }

}  // namespace verge::sim
