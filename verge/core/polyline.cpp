// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/core/polyline.hpp"

#include <algorithm>
#include <cassert>
#include <limits>

namespace verge {
namespace {

double distance_to_segment(Vec2 a, Vec2 b, Vec2 p) {
  const Vec2 ab = b - a;
  const double squared = dot(ab, ab);
  const double t = squared > 0.0 ? std::clamp(dot(p - a, ab) / squared, 0.0, 1.0) : 0.0;
  return distance(p, a + t * ab);
}

}  // namespace

double length(std::span<const Vec2> line) {
  double sum = 0.0;
  for (std::size_t i = 1; i < line.size(); ++i) sum += distance(line[i - 1], line[i]);
  return sum;
}

std::vector<Vec2> resample(std::span<const Vec2> line, double step) {
  assert(step > 0.0);
  if (line.size() < 2) return {line.begin(), line.end()};
  std::vector<Vec2> out;
  double station = 0.0;  // arc length of the next point to emit
  double start = 0.0;    // arc length of the current segment's first end
  for (std::size_t i = 1; i < line.size(); ++i) {
    const double segment = distance(line[i - 1], line[i]);
    constexpr double kSlack = 1e-9;  // a station that rounding pushed just past the end still counts
    while (station <= start + segment + kSlack && segment > 0.0) {
      out.push_back(line[i - 1] + std::min(1.0, (station - start) / segment) * (line[i] - line[i - 1]));
      station = static_cast<double>(out.size()) * step;
    }
    start += segment;
  }
  if (out.empty()) out.push_back(line.front());
  return out;
}

double distance_to(std::span<const Vec2> line, Vec2 p) {
  if (line.size() == 1) return distance(line.front(), p);
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 1; i < line.size(); ++i)
    least = std::min(least, distance_to_segment(line[i - 1], line[i], p));
  return least;
}

}  // namespace verge
