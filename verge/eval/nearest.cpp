// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/eval/nearest.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace verge::eval {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

double distance_to_segment(const Segment& segment, Vec2 p) {
  constexpr double kLeastSquared = 1e-12;  // below it the segment is a point
  const Vec2 d = segment.b - segment.a;
  const Vec2 from_a = p - segment.a;
  const double t = std::clamp(dot(from_a, d) / std::max(dot(d, d), kLeastSquared), 0.0, 1.0);
  return std::hypot(from_a.x - t * d.x, from_a.y - t * d.y);
}

}  // namespace

NearestPoint::NearestPoint(std::span<const Vec2> points, double limit)
    : points_(points.begin(), points.end()), limit_(limit) {
  std::sort(points_.begin(), points_.end(), [](Vec2 a, Vec2 b) { return a.x < b.x; });
}

double NearestPoint::distance(Vec2 p) const {
  const auto is_left = [](Vec2 point, double x) { return point.x < x; };
  double nearest = kInfinity;
  for (auto it = std::lower_bound(points_.begin(), points_.end(), p.x - limit_, is_left);
       it != points_.end() && it->x <= p.x + limit_; ++it) {
    if (std::fabs(it->y - p.y) <= limit_) nearest = std::min(nearest, std::hypot(p.x - it->x, p.y - it->y));
  }
  if (nearest < limit_) return nearest;
  return kInfinity;
}

NearestSegment::NearestSegment(std::span<const Segment> segments, double limit) : limit_(limit) {
  entries_.reserve(segments.size());
  for (const Segment& s : segments) {
    entries_.push_back({s,
                        {std::min(s.a.x, s.b.x), std::min(s.a.y, s.b.y)},
                        {std::max(s.a.x, s.b.x), std::max(s.a.y, s.b.y)}});
  }
  std::sort(entries_.begin(), entries_.end(),
            [](const Entry& a, const Entry& b) { return a.least.x < b.least.x; });
}

double NearestSegment::distance(Vec2 p) const {
  double nearest = kInfinity;
  for (const Entry& e : entries_) {
    if (e.least.x > p.x + limit_) break;
    const bool beside =
        e.greatest.x < p.x - limit_ || e.greatest.y < p.y - limit_ || e.least.y > p.y + limit_;
    if (!beside) nearest = std::min(nearest, distance_to_segment(e.segment, p));
  }
  if (nearest < limit_) return nearest;
  return kInfinity;
}

}  // namespace verge::eval
