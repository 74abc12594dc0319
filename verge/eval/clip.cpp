// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/eval/clip.hpp"

#include <algorithm>
#include <cmath>

namespace verge::eval {

std::optional<std::pair<double, double>> share_inside(const Segment& segment, double radius) {
  const Vec2 ab = segment.b - segment.a;
  const double squared = dot(ab, ab);
  if (squared == 0.0) return norm(segment.a) <= radius ? std::optional{std::pair{0.0, 1.0}} : std::nullopt;
  // |a + t ab|^2 = radius^2, solved by way of the line's distance from the origin, which keeps its digits
  // however far away the ends are.
  const double aside = cross(segment.a, ab);
  const double half_chord = std::sqrt(squared * radius * radius - aside * aside);
  if (std::isnan(half_chord)) return std::nullopt;
  const double from = std::max(0.0, (-dot(segment.a, ab) - half_chord) / squared);
  const double to = std::min(1.0, (-dot(segment.a, ab) + half_chord) / squared);
  return from <= to ? std::optional{std::pair{from, to}} : std::nullopt;
}

std::vector<std::vector<Vec2>> clip(std::span<const Vec2> line, double radius) {
  std::vector<std::vector<Vec2>> parts;
  if (line.size() == 1 && norm(line.front()) <= radius) parts.push_back({line.front()});
  bool goes_on = false;  // the last part ends where the next segment begins
  for (std::size_t i = 1; i < line.size(); ++i) {
    const auto inside = share_inside({line[i - 1], line[i]}, radius);
    if (inside) {
      const Vec2 ab = line[i] - line[i - 1];
      if (!goes_on || inside->first > 0.0) parts.push_back({line[i - 1] + inside->first * ab});
      parts.back().push_back(line[i - 1] + inside->second * ab);
    }
    goes_on = inside && inside->second >= 1.0;
  }
  return parts;
}

}  // namespace verge::eval
