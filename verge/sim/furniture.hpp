// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "verge/core/pose.hpp"
#include "verge/core/vec.hpp"
#include "verge/sim/land.hpp"
#include "verge/sim/thing.hpp"
#include "verge/sim/world.hpp"

namespace verge::sim {

/// One thing that stands or moves.
struct Placed {
  std::uint32_t id = 0;  ///< 1, 2, ... in the order of roads, rows and items.
  Thing what = Thing::kCar;
  Vec3 size;
  std::size_t road = 0;
  Item item;  ///< Where it is and how it moves; sizes are not used.

  [[nodiscard]] bool moves() const { return item.speed_mps != 0.0 || item.across_mps != 0.0; }
};

/// All that stands or moves on a land.
class Furniture {
 public:
  /// The land must outlive it. Throws std::invalid_argument where a row is no row or an item no item.
  explicit Furniture(const Land& land);

  [[nodiscard]] const std::vector<Placed>& things() const { return things_; }

  /// T_world_thing: the middle of its foot, +x along its length, so many seconds after the start.
  [[nodiscard]] Pose pose(const Placed& thing, double time_s) const;

  /// Adds what never moves: things at rest, walls, guard rails, hedges.
  void add_still(World& world) const;

  /// What moves, in the order of things(): each in its own frame.
  [[nodiscard]] std::vector<World> bodies() const;
  /// T_world_body of each of bodies().
  [[nodiscard]] std::vector<Pose> poses_of_bodies(double time_s) const;

 private:
  void place(std::size_t road, const Row& row);
  void add_continuous(World& world, std::size_t road, const Row& row) const;

  const Land& land_;
  std::vector<Placed> things_;
};

}  // namespace verge::sim
