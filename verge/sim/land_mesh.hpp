// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "verge/sim/ground.hpp"
#include "verge/sim/world.hpp"

namespace verge::sim {

class Land;

/// Longest stretch of the outline of a land on such ground, metres: bumps are resolved along it too.
[[nodiscard]] double outline_step(const GroundConfig& ground);

/// The land as triangles; see Land::mesh().
[[nodiscard]] World mesh_of(const Land& land);

}  // namespace verge::sim
