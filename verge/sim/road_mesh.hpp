// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "verge/sim/road.hpp"
#include "verge/sim/world.hpp"

namespace verge::sim {

/// How the mesh may depart from the true arcs, metres.
inline constexpr double kChordErrorMax_m = 0.5e-3;

/// Stations of the mesh's cross-sections: every joint of two pieces, and so many between that no chord of a
/// curve departs from its arc by more than kChordErrorMax_m anywhere on the strip; on straights every 10 m.
[[nodiscard]] std::vector<double> mesh_stations(const Road& road);

/// The road with its kerbs, sidewalks and verges, the houses if there are any, and flat ground that reaches
/// 150 m beyond it to every side.
[[nodiscard]] World make_world(const Road& road);

}  // namespace verge::sim
