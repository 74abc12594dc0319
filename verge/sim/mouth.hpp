// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "verge/sim/outline.hpp"
#include "verge/sim/road.hpp"

namespace verge::sim {

/// Where each branch leaves its road, in the order of the roads: the two arcs of its radius that touch an
/// edge of both, found by Newton's method to 1e-9 m. Throws std::invalid_argument with the number of the
/// branch whose arcs do not fit.
[[nodiscard]] std::vector<Mouth> make_mouths(const std::vector<Road>& roads);

}  // namespace verge::sim
