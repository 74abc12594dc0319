// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "verge/core/fields.hpp"
#include "verge/core/vec.hpp"
#include "verge/sim/world.hpp"

namespace verge::sim {

/// What can stand or move on the road or beside it.
enum class Thing : std::uint8_t {
  kCar,
  kVan,
  kTruck,
  kTrailer,
  kCyclist,
  kPerson,
  kPole,
  kTree,
  kBin,
  kBarrel,
  kHouse,
  kWall,
  kGuardRail,
  kHedge,
  kSign
};

}  // namespace verge::sim

namespace verge {
template <>
inline constexpr std::array enum_names<sim::Thing> =
    std::to_array<std::string_view>({"car", "van", "truck", "trailer", "cyclist", "person", "pole", "tree",
                                     "bin", "barrel", "house", "wall", "guard_rail", "hedge", "sign"});
}  // namespace verge

namespace verge::sim {

/// Whether it is as long as the row that it stands in: walls, guard rails, hedges.
[[nodiscard]] bool is_continuous(Thing thing);

/// Length, width and height of a usual one, metres; of a continuous one, a length of 0.
[[nodiscard]] Vec3 usual_size(Thing thing);

/// Its triangles within a box of that size, whose footprint's middle is the origin; its length along +x, its
/// foot at z = 0. The box's sides touch it. The body of a car, van, truck or trailer begins 0.25 m above the
/// road on four wheels and fills the box from there to half (car) or all of its height. The plate of a sign
/// looks back along its length. Throws
/// std::invalid_argument for a continuous thing.
[[nodiscard]] World shape_of(Thing thing, Vec3 size, std::uint32_t object);

}  // namespace verge::sim
