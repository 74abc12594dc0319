// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "verge/core/vec.hpp"

namespace verge::eval {

/// A straight piece of a line in the plane, metres.
struct Segment {
  Vec2 a;
  Vec2 b;

  friend bool operator==(const Segment&, const Segment&) = default;
};

/// The share of the segment inside the circle of `radius` around the origin, as its two ends in [0, 1]. None
/// where it stays outside, or its ends are so far away (1e150 m) that doubles cannot tell.
[[nodiscard]] std::optional<std::pair<double, double>> share_inside(const Segment& segment, double radius);

/// The parts of a polyline inside that circle, in order. Cut before it is sampled, a line to the horizon
/// costs no more than one within the range.
[[nodiscard]] std::vector<std::vector<Vec2>> clip(std::span<const Vec2> line, double radius);

}  // namespace verge::eval
