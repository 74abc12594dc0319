// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/fit/curvature.hpp"

#include <algorithm>
#include <cmath>

#include "verge/core/statistics.hpp"
#include "verge/fit/path.hpp"

namespace verge::fit {
namespace {

std::span<const double> between_the_ends(std::span<const double> values) {
  return values.size() < 3 ? std::span<const double>{} : values.subspan(1, values.size() - 2);
}

/// Both ends and every point between them that `is_key` picks.
template <class IsKey>
std::vector<std::size_t> with_ends(std::size_t size, IsKey is_key) {
  std::vector<std::size_t> keys;
  for (std::size_t i = 0; i < size; ++i) {
    if (i == 0 || i + 1 == size || is_key(i)) keys.push_back(i);
  }
  return keys;
}

/// Whether no point within `reach_m` along the path exceeds point i, and none before it equals it.
bool is_first_peak(std::span<const double> values, std::span<const double> s, std::size_t i, double reach_m) {
  for (std::size_t j = i; j-- > 0 && s[i] - s[j] <= reach_m;) {
    if (values[j] >= values[i]) return false;
  }
  for (std::size_t j = i + 1; j < values.size() && s[j] - s[i] <= reach_m; ++j) {
    if (values[j] > values[i]) return false;
  }
  return true;
}

}  // namespace

std::optional<Circle> circle_through(Vec2 a, Vec2 b, Vec2 c) {
  const Vec2 ab = b - a;
  const Vec2 ac = c - a;
  const double area = 2.0 * cross(ab, ac);
  if (area == 0.0) return std::nullopt;
  // From a to the centre: on the bisector of ab its product with ab is |ab|^2 / 2, and likewise for ac.
  const Vec2 to_centre =
      (1.0 / area) * Vec2{dot(ab, ab) * ac.y - dot(ac, ac) * ab.y, dot(ac, ac) * ab.x - dot(ab, ab) * ac.x};
  const double radius = norm(to_centre);
  if (!std::isfinite(radius)) return std::nullopt;  // collinear to within rounding
  return Circle{a + to_centre, radius};
}

std::vector<double> curvature(std::span<const Vec2> points) {
  std::vector<double> k(points.size(), 0.0);
  for (std::size_t i = 1; i + 1 < points.size(); ++i) {
    const auto circle = circle_through(points[i - 1], points[i], points[i + 1]);
    if (circle) k[i] = 1.0 / circle->radius_m;
  }
  return k;
}

std::vector<std::size_t> key_points(std::span<const double> curvature) {
  const double k_avg = mean(between_the_ends(curvature)).value_or(0.0);
  return with_ends(curvature.size(), [&](std::size_t i) { return curvature[i] >= k_avg; });
}

std::vector<double> smoothed_curvature(std::span<const Vec2> points, double window_m) {
  const std::vector<Vec2> smooth = moving_mean(points, window_m);
  const std::vector<double> s = arc_lengths(smooth);
  std::vector<double> k(points.size(), 0.0);
  for (std::size_t i = 0; i < k.size(); ++i) {
    if (s[i] < window_m || s.back() - s[i] < window_m) continue;
    const auto before = std::ranges::upper_bound(s, s[i] - window_m) - s.begin() - 1;
    const auto after = std::ranges::lower_bound(s, s[i] + window_m) - s.begin();
    const auto circle = circle_through(smooth[static_cast<std::size_t>(before)], smooth[i],
                                       smooth[static_cast<std::size_t>(after)]);
    if (circle) k[i] = 1.0 / circle->radius_m;
  }
  return k;
}

std::vector<std::size_t> smoothed_key_points(std::span<const Vec2> points, std::span<const double> curvature,
                                             double window_m) {
  const std::vector<double> s = arc_lengths(points);
  const double k_avg = mean(between_the_ends(curvature)).value_or(0.0);
  return with_ends(points.size(), [&](std::size_t i) {
    return curvature[i] > 0.0 && curvature[i] >= k_avg && is_first_peak(curvature, s, i, 0.5 * window_m);
  });
}

}  // namespace verge::fit
