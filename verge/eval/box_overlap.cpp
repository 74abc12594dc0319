// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/eval/box_overlap.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include "verge/core/vec.hpp"
#include "verge/model/footprint.hpp"

namespace verge::eval {
namespace {

double area_of(std::span<const Vec2> polygon) {
  double doubled = 0.0;
  for (std::size_t i = 0; i < polygon.size(); ++i)
    doubled += cross(polygon[i], polygon[(i + 1) % polygon.size()]);
  return 0.5 * doubled;
}

/// The part of a convex polygon left of the line through a and b (Sutherland and Hodgman 1974).
std::vector<Vec2> left_of(std::span<const Vec2> polygon, Vec2 a, Vec2 b) {
  std::vector<Vec2> kept;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec2 p = polygon[i];
    const Vec2 q = polygon[(i + 1) % polygon.size()];
    const double at_p = cross(b - a, p - a);
    const double at_q = cross(b - a, q - a);
    if (at_p >= 0.0) kept.push_back(p);
    if ((at_p > 0.0 && at_q < 0.0) || (at_p < 0.0 && at_q > 0.0))
      kept.push_back(p + at_p / (at_p - at_q) * (q - p));
  }
  return kept;
}

double footprint_area(const Object& object) { return object.size.length_m * object.size.width_m; }

}  // namespace

double shared_area(const Object& a, const Object& b) {
  const auto of_a = footprint(a);
  const auto of_b = footprint(b);
  std::vector<Vec2> shared(of_a.begin(), of_a.end());
  for (std::size_t i = 0; i < of_b.size(); ++i)
    shared = left_of(shared, of_b.at(i), of_b.at((i + 1) % of_b.size()));
  return std::max(0.0, area_of(shared));
}

double intersection_over_union(const Object& a, const Object& b) {
  if (footprint_area(a) <= 0.0 || footprint_area(b) <= 0.0) return 0.0;
  const double shared = shared_area(a, b);
  return shared / (footprint_area(a) + footprint_area(b) - shared);
}

}  // namespace verge::eval
