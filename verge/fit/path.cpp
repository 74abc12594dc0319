// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/fit/path.hpp"

#include <algorithm>
#include <numeric>
#include <tuple>

namespace verge::fit {

std::vector<Vec2> gather(std::span<const Vec2> points, std::span<const std::size_t> indices) {
  std::vector<Vec2> out;
  out.reserve(indices.size());
  for (const std::size_t i : indices) out.push_back(points[i]);
  return out;
}

std::vector<std::size_t> order_along(std::span<const Vec2> points, Vec2 direction) {
  std::vector<std::size_t> order(points.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::sort(order, {}, [&](std::size_t i) {
    return std::tuple{dot(direction, points[i]), cross(direction, points[i]), i};
  });
  return order;
}

std::vector<std::size_t> drop_duplicates(std::span<const Vec2> points, double least_m) {
  std::vector<std::size_t> kept;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (kept.empty() || distance(points[kept.back()], points[i]) >= least_m) kept.push_back(i);
  }
  return kept;
}

std::vector<double> arc_lengths(std::span<const Vec2> points) {
  std::vector<double> s(points.size(), 0.0);
  for (std::size_t i = 1; i < points.size(); ++i) s[i] = s[i - 1] + distance(points[i - 1], points[i]);
  return s;
}

std::vector<Vec2> moving_mean(std::span<const Vec2> points, double window_m) {
  const std::vector<double> s = arc_lengths(points);
  std::vector<Vec2> sums(points.size() + 1);
  for (std::size_t i = 0; i < points.size(); ++i) sums[i + 1] = sums[i] + points[i];
  std::vector<Vec2> out;
  out.reserve(points.size());
  for (const double here : s) {
    constexpr double kSlack = 1e-9;  // a point that rounding put just outside the window still counts
    const double reach = std::min({0.5 * window_m, here, s.back() - here}) + kSlack;
    const auto from = std::ranges::lower_bound(s, here - reach) - s.begin();
    const auto to = std::ranges::upper_bound(s, here + reach) - s.begin();
    const Vec2 sum = sums[static_cast<std::size_t>(to)] - sums[static_cast<std::size_t>(from)];
    out.push_back((1.0 / static_cast<double>(to - from)) * sum);
  }
  return out;
}

}  // namespace verge::fit
