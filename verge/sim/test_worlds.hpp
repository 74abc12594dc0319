// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <utility>

#include "verge/sim/caster.hpp"
#include "verge/sim/world.hpp"

// Worlds whose ranges are known in closed form.

namespace verge::sim::testing {

/// The plane z = 0, as far as any sensor sees.
[[nodiscard]] inline Caster flat_ground() {
  World world;
  add_ground(world, {0.0, 0.0, 0.0}, 500.0, Surface::kGround);
  return Caster(std::move(world));
}

}  // namespace verge::sim::testing
