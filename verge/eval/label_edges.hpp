// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "verge/core/vec.hpp"
#include "verge/eval/label_scheme.hpp"
#include "verge/eval/labelled_truth.hpp"

namespace verge::eval {

/// Points of one ring in order of azimuth, once around, and the class of each (as many).
struct LabelledRing {
  std::vector<Vec3> points;
  std::vector<std::uint32_t> labels;
};

/// The truth of semantic labels over a whole scan (its frame is left empty). Rings in order of elevation, up
/// or down.
///
/// True points: in each ring the midpoints of two neighbouring returns, less than `gap_m` apart in the plane,
/// of which one is drivable and the other off the road. Runs of under 4 returns that differ from both
/// neighbours are label flicker and take their label. The step of a true point is the height difference of
/// the medians of the ring's returns 0.1 to 0.5 m away on either side, 25 returns at most.
///
/// Hidden are: such pairs of neighbours wider apart (below 3 m); edges of parking areas; and, from a ring to
/// the next one along one azimuth, pairs below 6 m apart whose kinds differ. Rings of fewer than three points
/// tell nothing.
[[nodiscard]] LabelledTruth find_label_edges(std::span<const LabelledRing> rings, LabelScheme scheme,
                                             double gap_m);

}  // namespace verge::eval
