// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/eval/join_points.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>

namespace verge::eval {
namespace {

using PlacesByRing = std::map<std::size_t, std::vector<Vec2>>;

double range_of(Vec2 p) { return std::hypot(p.x, p.y); }
double apart(Vec2 a, Vec2 b) { return std::hypot(a.x - b.x, a.y - b.y); }

/// The nearest point of a ring that is near enough to be the same boundary.
std::optional<Vec2> continuation(const PlacesByRing& rings, std::size_t ring, Vec2 p) {
  constexpr double kFarthest_m = 8.0;
  const auto found = rings.find(ring);
  if (found == rings.end()) return std::nullopt;
  const auto& places = found->second;
  const Vec2 nearest = *std::min_element(places.begin(), places.end(),
                                         [&](Vec2 a, Vec2 b) { return apart(a, p) < apart(b, p); });
  const double allowed = std::min(kFarthest_m, 1.0 + 2.0 * std::fabs(range_of(nearest) - range_of(p)));
  return apart(nearest, p) < allowed ? std::optional(nearest) : std::nullopt;
}

}  // namespace

std::vector<Segment> join_rings(std::span<const RingPoint> points) {
  PlacesByRing rings;
  for (const RingPoint& p : points) rings[p.ring].push_back(p.place);
  std::vector<Segment> segments;
  for (const RingPoint& p : points) {
    auto next = continuation(rings, p.ring + 1, p.place);
    if (!next) next = continuation(rings, p.ring + 2, p.place);
    if (next) segments.push_back({p.place, *next});
  }
  return segments;
}

std::vector<Segment> join_near(std::span<const Vec2> points) {
  constexpr double kReach_m = 1.5;
  std::vector<Segment> segments;
  std::vector<std::size_t> order(points.size());
  for (const Vec2 p : points) {
    std::iota(order.begin(), order.end(), std::size_t{0});
    const auto nearer = [&](std::size_t a, std::size_t b) {
      const double to_a = apart(points[a], p);
      const double to_b = apart(points[b], p);
      return to_a != to_b ? to_a < to_b : a < b;
    };
    // The nearest is the point itself.
    const std::size_t count = std::min<std::size_t>(3, order.size());
    std::partial_sort(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(count), order.end(), nearer);
    for (std::size_t i = 1; i < count; ++i) {
      const Vec2 neighbour = points[order[i]];
      if (apart(neighbour, p) < kReach_m) segments.push_back({p, neighbour});
    }
  }
  return segments;
}

}  // namespace verge::eval
