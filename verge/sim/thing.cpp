// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/sim/thing.hpp"

#include <algorithm>
#include <stdexcept>

namespace verge::sim {
namespace {

constexpr double kClearance_m = 0.25;
constexpr int kRound = 12;  // sides of what is round

// A box within the whole: shares of its length and width, from one height to another.
void add_part(World& world, Vec3 size, double share_x, double shift_x, double share_y, double from, double to,
              Surface surface, std::uint32_t object) {
  add_box(world, {{shift_x * size.x, 0.0, from}, {share_x * size.x, share_y * size.y, to - from}, 0.0},
          surface, object);
}

void add_wheels(World& world, Vec3 size, std::uint32_t object) {
  for (const double x : {-0.3, 0.3}) {
    for (const double y : {-0.42, 0.42}) {
      add_box(world, {{x * size.x, y * size.y, 0.0}, {0.65, 0.12 * size.y, 0.65}, 0.0}, Surface::kVehicle,
              object);
    }
  }
}

World car(Vec3 size, std::uint32_t object) {
  World world;
  add_part(world, size, 1.0, 0.0, 1.0, kClearance_m, 0.55 * size.z, Surface::kVehicle, object);
  add_part(world, size, 0.5, -0.06, 0.9, 0.55 * size.z, size.z, Surface::kVehicle, object);
  add_wheels(world, size, object);
  return world;
}

World carrier(Vec3 size, std::uint32_t object) {
  World world;
  add_part(world, size, 1.0, 0.0, 1.0, kClearance_m, size.z, Surface::kVehicle, object);
  add_wheels(world, size, object);
  return world;
}

// A cab and, behind a gap, a load.
World truck(Vec3 size, std::uint32_t object) {
  World world;
  add_part(world, size, 0.22, 0.39, 1.0, 0.4, 0.85 * size.z, Surface::kVehicle, object);
  add_part(world, size, 0.75, -0.125, 1.0, 0.9, size.z, Surface::kVehicle, object);
  add_part(world, size, 1.0, 0.0, 0.4, 0.6, 0.9, Surface::kVehicle, object);
  add_wheels(world, size, object);
  return world;
}

// Trunk, shoulders, head.
void add_person(World& world, Vec3 base, Vec3 size, std::uint32_t object) {
  const double radius = 0.5 * std::min(size.x, size.y);
  add_prism(world, base, 0.8 * radius, radius, 0.8 * size.z, kRound, Surface::kPerson, object);
  add_prism(world, base + Vec3{0.0, 0.0, 0.8 * size.z}, 0.45 * radius, 0.45 * radius, 0.2 * size.z, kRound,
            Surface::kPerson, object);
}

World person(Vec3 size, std::uint32_t object) {
  World world;
  add_person(world, {}, size, object);
  return world;
}

World cyclist(Vec3 size, std::uint32_t object) {
  World world;
  add_box(world, {{}, {size.x, 0.08, 0.55 * size.z}, 0.0}, Surface::kPerson, object);
  add_person(world, {0.0, 0.0, 0.45 * size.z}, {size.y, size.y, 0.55 * size.z}, object);
  return world;
}

World tree(Vec3 size, std::uint32_t object) {
  World world;
  const double crown = 0.5 * std::min(size.x, size.y);
  const double bare = 0.4 * size.z;
  add_prism(world, {}, 0.2, 0.15, bare, kRound, Surface::kVegetation, object);
  add_prism(world, {0.0, 0.0, bare}, 0.4 * crown, crown, 0.3 * size.z, kRound, Surface::kVegetation, object);
  add_prism(world, {0.0, 0.0, 0.7 * size.z}, crown, 0.3 * crown, 0.3 * size.z, kRound, Surface::kVegetation,
            object);
  return world;
}

World prism(Vec3 size, Surface surface, std::uint32_t object) {
  World world;
  const double radius = 0.5 * std::min(size.x, size.y);
  add_prism(world, {}, radius, radius, size.z, kRound, surface, object);
  return world;
}

// A plate as high as it is wide, across its heading, on a post behind it.
World sign(Vec3 size, std::uint32_t object) {
  World world;
  constexpr double kPlate_m = 0.005;
  const double foot = std::max(0.0, size.z - size.y);
  add_box(world, {{0.5 * (kPlate_m - size.x), 0.0, foot}, {kPlate_m, size.y, size.z - foot}, 0.0},
          Surface::kReflector, object);
  add_box(world, {{0.5 * kPlate_m, 0.0, 0.0}, {size.x - kPlate_m, 0.06, size.z}, 0.0}, Surface::kRail,
          object);
  return world;
}

World box(Vec3 size, Surface surface, std::uint32_t object) {
  World world;
  add_box(world, {{}, size, 0.0}, surface, object);
  return world;
}

}  // namespace

bool is_continuous(Thing thing) {
  return thing == Thing::kWall || thing == Thing::kGuardRail || thing == Thing::kHedge;
}

Vec3 usual_size(Thing thing) {
  static constexpr std::array<Vec3, enum_names<Thing>.size()> kSizes = {{{4.4, 1.8, 1.5},
                                                                         {5.4, 2.0, 2.4},
                                                                         {9.0, 2.5, 3.6},
                                                                         {7.0, 2.4, 3.0},
                                                                         {1.8, 0.6, 1.75},
                                                                         {0.5, 0.5, 1.75},
                                                                         {0.16, 0.16, 5.0},
                                                                         {4.0, 4.0, 7.0},
                                                                         {0.6, 0.6, 1.1},
                                                                         {0.6, 0.6, 1.0},
                                                                         {10.0, 6.0, 6.0},
                                                                         {0.0, 0.3, 2.0},
                                                                         {0.0, 0.1, 0.75},
                                                                         {0.0, 0.8, 1.3},
                                                                         {0.06, 0.6, 2.8}}};
  return kSizes.at(static_cast<std::size_t>(thing));
}

World shape_of(Thing thing, Vec3 size, std::uint32_t object) {
  switch (thing) {
    case Thing::kCar:
      return car(size, object);
    case Thing::kVan:
    case Thing::kTrailer:
      return carrier(size, object);
    case Thing::kTruck:
      return truck(size, object);
    case Thing::kCyclist:
      return cyclist(size, object);
    case Thing::kPerson:
      return person(size, object);
    case Thing::kTree:
      return tree(size, object);
    case Thing::kPole:
      return prism(size, Surface::kRail, object);
    case Thing::kBarrel:
      return prism(size, Surface::kPlastic, object);
    case Thing::kBin:
      return box(size, Surface::kRail, object);
    case Thing::kHouse:
      return box(size, Surface::kWall, object);
    case Thing::kSign:
      return sign(size, object);
    case Thing::kWall:
    case Thing::kGuardRail:
    case Thing::kHedge:
      break;
  }
  throw std::invalid_argument("a wall, guard rail or hedge is as long as its row");
}

}  // namespace verge::sim
