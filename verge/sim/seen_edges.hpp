// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "verge/model/scene.hpp"
#include "verge/scan/scan.hpp"

namespace verge::sim {

/// Tells of true boundaries what the scan saw of their faces: a vertex is kVisible where it lies between
/// returns of the kerb, three or more that follow each other along it by no more than 2 m, and kOccluded
/// elsewhere. Stricter than what Truth says, which asks only whether nothing stands in between. `scan`:
/// deskewed, with labels as simulate_scan gives them.
void tell_seen_edges(std::vector<Boundary>& boundaries, const Scan& scan);

}  // namespace verge::sim
