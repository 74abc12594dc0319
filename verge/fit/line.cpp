// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/fit/line.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <utility>

#include "verge/fit/finite.hpp"

namespace verge::fit {
namespace {

/// Weighted mean and second moments about it.
struct Moments {
  Vec2 centroid;
  double xx = 0.0;
  double xy = 0.0;
  double yy = 0.0;
};

Moments moments(std::span<const Vec2> points, std::span<const double> weights) {
  Vec2 sum;
  double total = 0.0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    sum = sum + weight_at(weights, i) * points[i];
    total += weight_at(weights, i);
  }
  Moments m{.centroid = {sum.x / total, sum.y / total}};
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double w = weight_at(weights, i);
    const Vec2 d = points[i] - m.centroid;
    m.xx += w * d.x * d.x;
    m.xy += w * d.x * d.y;
    m.yy += w * d.y * d.y;
  }
  return m;
}

/// Whether two points of positive weight differ under `differ`. Exact: the scatter cannot tell, because the
/// mean of equal points may be rounded.
template <class Differ>
bool any_two(std::span<const Vec2> points, std::span<const double> weights, Differ differ) {
  std::optional<Vec2> first;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!(weight_at(weights, i) > 0.0)) continue;
    if (first && differ(*first, points[i])) return true;
    if (!first) first = points[i];
  }
  return false;
}

/// d or -d, of unit length, with x >= 0.
Vec2 forward_unit(Vec2 d) { return ((d.x < 0.0 ? -1.0 : 1.0) / norm(d)) * d; }

/// The eigenvector of the greater eigenvalue of [xx xy; xy yy], from the better conditioned of its two rows:
/// its x is positive, or its x is 0 and its y positive.
Vec2 principal_axis(const Moments& m) {
  const double difference = m.xx - m.yy;
  const double spread = std::hypot(difference, 2.0 * m.xy);
  if (!(spread > 0.0)) return {1.0, 0.0};
  return difference >= 0.0 ? forward_unit({difference + spread, 2.0 * m.xy})
                           : forward_unit({2.0 * m.xy, spread - difference});
}

std::vector<double> signed_distances(const Line& line, std::span<const Vec2> points) {
  std::vector<double> distances(points.size());
  std::ranges::transform(points, distances.begin(), [&](Vec2 p) { return signed_distance(line, p); });
  return distances;
}

}  // namespace

Line line_along(Vec2 point, Vec2 direction) { return {point, forward_unit(direction)}; }

LineFit measured(const Line& line, std::span<const Vec2> points, std::span<const double> weights,
                 std::vector<double> final_weights) {
  return {line, summarise(signed_distances(line, points), weights), std::move(final_weights)};
}

std::optional<Line> orthogonal_line(std::span<const Vec2> points, std::span<const double> weights) {
  assert(weights.empty() || weights.size() == points.size());
  const auto differ = [](Vec2 a, Vec2 b) { return a != b; };
  if (!all_finite(points) || !any_two(points, weights, differ)) return std::nullopt;
  const Moments m = moments(points, weights);
  return Line{m.centroid, principal_axis(m)};
}

std::optional<Line> ordinary_line(std::span<const Vec2> points, std::span<const double> weights) {
  assert(weights.empty() || weights.size() == points.size());
  const auto differ = [](Vec2 a, Vec2 b) { return a.x != b.x; };
  if (!all_finite(points) || !any_two(points, weights, differ)) return std::nullopt;
  const Moments m = moments(points, weights);
  return line_along(m.centroid, {m.xx, m.xy});
}

std::optional<LineFit> fit_line(std::span<const Vec2> points, std::span<const double> weights) {
  const auto line = orthogonal_line(points, weights);
  if (!line) return std::nullopt;
  return measured(*line, points, weights, weights_or_ones(weights, points.size()));
}

std::optional<LineFit> fit_line_ordinary(std::span<const Vec2> points, std::span<const double> weights) {
  const auto line = ordinary_line(points, weights);
  if (!line) return std::nullopt;
  return measured(*line, points, weights, weights_or_ones(weights, points.size()));
}

std::optional<LineFit> fit_line_robust(std::span<const Vec2> points, const RobustOptions& options,
                                       std::span<const double> weights) {
  std::optional<Line> line = orthogonal_line(points, weights);
  if (!line) return std::nullopt;
  std::vector<double> final_weights = weights_or_ones(weights, points.size());
  for (int i = 0; i < options.start_iterations + options.iterations; ++i) {
    auto next = robust_weights(i, signed_distances(*line, points), weights, options);
    const auto refit = orthogonal_line(points, next);
    if (!refit) break;  // the points that still weigh something coincide: the line before stands
    line = refit;
    final_weights = std::move(next);
  }
  return measured(*line, points, weights, std::move(final_weights));
}

}  // namespace verge::fit
