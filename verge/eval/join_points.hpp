// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "verge/core/vec.hpp"
#include "verge/eval/clip.hpp"

namespace verge::eval {

/// A point and the ring that it lies in.
struct RingPoint {
  Vec2 place;
  std::size_t ring = 0;
};

/// Segments from each point to the nearest one of the next ring, or of the one after it where the next has
/// none near enough: below 8 m, and below 1 m + 2 x the difference of the two ranges.
[[nodiscard]] std::vector<Segment> join_rings(std::span<const RingPoint> points);

/// Segments from each point to its two nearest neighbours within 1.5 m.
[[nodiscard]] std::vector<Segment> join_near(std::span<const Vec2> points);

}  // namespace verge::eval
