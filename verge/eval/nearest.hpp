// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "verge/core/vec.hpp"
#include "verge/eval/clip.hpp"

namespace verge::eval {

/// Distances from a set of points, metres, as far as they are below a limit. What lies farther in x or y
/// alone is not looked at, so that thousands of queries against thousands of points take milliseconds; memory
/// is that of the points.
class NearestPoint {
 public:
  NearestPoint(std::span<const Vec2> points, double limit);

  /// Distance of the nearest point; infinity where none is nearer than the limit.
  [[nodiscard]] double distance(Vec2 p) const;

 private:
  std::vector<Vec2> points_;  // by x
  double limit_;
};

/// Likewise from a set of segments.
class NearestSegment {
 public:
  NearestSegment(std::span<const Segment> segments, double limit);

  [[nodiscard]] double distance(Vec2 p) const;

 private:
  struct Entry {
    Segment segment;
    Vec2 least;  // corners of its box
    Vec2 greatest;
  };
  std::vector<Entry> entries_;  // by least.x
  double limit_;
};

}  // namespace verge::eval
