// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/sim/furniture.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "verge/core/angle.hpp"

namespace verge::sim {
namespace {

Vec3 size_of(Thing what, double length, double width, double height) {
  const Vec3 usual = usual_size(what);
  return {length > 0.0 ? length : usual.x, width > 0.0 ? width : usual.y, height > 0.0 ? height : usual.z};
}

// From the edge to the middle of a row.
double middle_beside(const Row& row, double width) {
  return row.beside_m < 0.0 ? row.beside_m - 0.5 * width : row.beside_m + 0.5 * width;
}

// A point beside an edge; the edge's own offset and normal, so that rows follow bays and tapers.
Vec2 beside(const Road& road, RoadSide side, double station, double outward_m) {
  const EdgePoint edge = road.edge_point(side, station);
  return edge.position + outward_m * edge.outward;
}

// The section of a continuous thing: height over the ground of its lower and its upper side.
Vec2 upright(Thing what, double height) {
  return what == Thing::kGuardRail ? Vec2{height - 0.31, height} : Vec2{-0.2, height};
}

Surface surface_of(Thing what) {
  if (what == Thing::kHedge) return Surface::kVegetation;
  return what == Thing::kGuardRail ? Surface::kRail : Surface::kWall;
}

/// One cross-section of a wall, rail or hedge: near lower, near upper, far upper, far lower.
using Slice = std::array<Vec3, 4>;

Slice slice_at(const Land& land, const Road& road, const Row& row, Vec3 size, double station) {
  const Vec2 lift = upright(row.what, size.z);
  const Vec2 near = beside(road, row.side, station, row.beside_m);
  const double far_m = row.beside_m < 0.0 ? row.beside_m - size.y : row.beside_m + size.y;
  const Vec2 far = beside(road, row.side, station, far_m);
  const double ground = land.height(0.5 * (near + far));
  return {Vec3{near.x, near.y, ground + lift.x},
          {near.x, near.y, ground + lift.y},
          {far.x, far.y, ground + lift.y},
          {far.x, far.y, ground + lift.x}};
}

void add_slab(World& world, const Slice& a, const Slice& b, Surface surface) {
  for (std::size_t i = 0; i < a.size(); ++i) {
    const std::size_t j = (i + 1) % a.size();
    add_quad(world, a.at(i), b.at(i), b.at(j), a.at(j), surface);
  }
}

void add_lid(World& world, const Slice& a, Surface surface) {
  add_quad(world, a[0], a[1], a[2], a[3], surface);
}

}  // namespace

Furniture::Furniture(const Land& land) : land_(land) {
  for (std::size_t road = 0; road < land.roads().size(); ++road) {
    const RoadConfig& config = land.roads()[road].config();
    for (const Row& row : config.rows) place(road, row);
    for (const Item& item : config.items) {
      if (is_continuous(item.what)) throw std::invalid_argument("a wall, guard_rail or hedge must be a row");
      const Vec3 size = size_of(item.what, item.length_m, item.width_m, item.height_m);
      things_.push_back({static_cast<std::uint32_t>(things_.size() + 1), item.what, size, road, item});
    }
  }
}

void Furniture::place(std::size_t road, const Row& row) {
  if (is_continuous(row.what)) return;
  const Road& r = land_.roads()[road];
  const Vec3 size = size_of(row.what, row.length_m, row.width_m, row.height_m);
  const double end = std::min(row.to_m, r.length_m());
  for (double from = row.from_m; from + size.x <= end + 1e-9; from += size.x + row.gap_m) {
    const double middle = from + 0.5 * size.x;
    if (in_mouth(land_.outline(), road, row.side, from, from + size.x)) continue;
    const double outward = r.edge_offset(row.side, middle) + middle_beside(row, size.y);
    Item item{.what = row.what, .at_m = middle, .lateral_m = sign_of(row.side) * outward};
    if (row.side == RoadSide::kLeft) item.yaw_deg = 180.0;  // it faces as the traffic there does
    things_.push_back({static_cast<std::uint32_t>(things_.size() + 1), row.what, size, road, item});
  }
}

Pose Furniture::pose(const Placed& thing, double time_s) const {
  const CenterLine& line = land_.roads()[thing.road].line();
  const double station = thing.item.at_m + thing.item.speed_mps * time_s;
  const double lateral = thing.item.lateral_m + thing.item.across_mps * time_s;
  const Vec2 p = line.point(station, lateral);
  const double yaw = line.at(station).heading_rad + deg_to_rad(thing.item.yaw_deg);
  return {from_yaw_pitch_roll(yaw, 0.0, 0.0), {p.x, p.y, land_.height(p)}};
}

void Furniture::add_continuous(World& world, std::size_t road, const Row& row) const {
  constexpr double kStep_m = 0.5;
  const Road& r = land_.roads()[road];
  const Vec3 size = size_of(row.what, row.length_m, row.width_m, row.height_m);
  const Surface surface = surface_of(row.what);
  const double end = std::min(row.to_m, r.length_m());
  const int count = std::max(1, static_cast<int>(std::ceil((end - row.from_m) / kStep_m)));
  const double step = (end - row.from_m) / count;
  bool open = false;  // a slab ends at the slice before
  for (int i = 0; i < count; ++i) {
    const double from = row.from_m + step * i;
    const Slice a = slice_at(land_, r, row, size, from);
    const bool free = in_mouth(land_.outline(), road, row.side, from, from + step);
    if (open == free) add_lid(world, a, surface);
    open = !free;
    if (open) add_slab(world, a, slice_at(land_, r, row, size, from + step), surface);
  }
  if (open) add_lid(world, slice_at(land_, r, row, size, end), surface);
}

void Furniture::add_still(World& world) const {
  for (const Placed& thing : things_) {
    if (thing.moves()) continue;
    const Pose T_world_thing = pose(thing, 0.0);
    add_world(world, shape_of(thing.what, thing.size, thing.id), T_world_thing.translation,
              yaw_of(T_world_thing.rotation));
  }
  for (std::size_t road = 0; road < land_.roads().size(); ++road) {
    for (const Row& row : land_.roads()[road].config().rows) {
      if (is_continuous(row.what) && row.from_m < std::min(row.to_m, land_.roads()[road].length_m())) {
        add_continuous(world, road, row);
      }
    }
  }
}

std::vector<World> Furniture::bodies() const {
  std::vector<World> bodies;
  for (const Placed& thing : things_) {
    if (thing.moves()) bodies.push_back(shape_of(thing.what, thing.size, thing.id));
  }
  return bodies;
}

std::vector<Pose> Furniture::poses_of_bodies(double time_s) const {
  std::vector<Pose> poses;
  for (const Placed& thing : things_) {
    if (thing.moves()) poses.push_back(pose(thing, time_s));
  }
  return poses;
}

}  // namespace verge::sim
