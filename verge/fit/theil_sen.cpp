// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/fit/theil_sen.hpp"

#include <algorithm>
#include <cmath>

#include "verge/core/random.hpp"
#include "verge/core/statistics.hpp"
#include "verge/fit/finite.hpp"
#include "verge/fit/pair_slopes.hpp"

namespace verge::fit {
namespace {

constexpr double kZ95 = 1.959963984540054;  // 97.5th percentile of the standard normal distribution
constexpr std::size_t kResamples = 599;
constexpr std::size_t kCutOff = 15;  // round(0.025 * 599) resamples beyond each end

Vec2 swapped(Vec2 p) { return {p.y, p.x}; }

/// The points as v on u: themselves, or with x and y exchanged.
std::vector<Vec2> along_axis(std::span<const Vec2> points, RegressionAxis axis) {
  std::vector<Vec2> uv(points.begin(), points.end());
  if (axis == RegressionAxis::kY) std::ranges::transform(uv, uv.begin(), swapped);
  return uv;
}

RegressionAxis axis_of(std::span<const Vec2> points, const TheilSenOptions& options) {
  return options.axis.value_or(longer_axis(points));
}

/// None where a coordinate is not finite or no pair has a slope.
std::optional<PairSlopes> pair_slopes(std::span<const Vec2> points, const TheilSenOptions& options) {
  if (!all_finite(points)) return std::nullopt;
  PairSlopes slopes(along_axis(points, axis_of(points, options)), options.min_step_m);
  if (slopes.size() == 0) return std::nullopt;
  return slopes;
}

/// The slopes at two places counted from 0; beyond the ends, at the ends.
SlopeInterval between(PairSlopes& slopes, double low, double high) {
  const double last = static_cast<double>(slopes.size() - 1);
  return {slopes.at(std::clamp(low, 0.0, last)), slopes.at(std::clamp(high, 0.0, last))};
}

/// The line v = slope u + intercept in x and y.
Line line_of(RegressionAxis axis, double u, double slope, double intercept) {
  const Vec2 point{u, slope * u + intercept};
  const Vec2 direction{1.0, slope};
  return axis == RegressionAxis::kX ? line_along(point, direction)
                                    : line_along(swapped(point), swapped(direction));
}

}  // namespace

RegressionAxis longer_axis(std::span<const Vec2> points) {
  if (points.empty()) return RegressionAxis::kX;
  const auto [left, right] = std::ranges::minmax(points, {}, &Vec2::x);
  const auto [low, high] = std::ranges::minmax(points, {}, &Vec2::y);
  return high.y - low.y > right.x - left.x ? RegressionAxis::kY : RegressionAxis::kX;
}

std::optional<LineFit> fit_line_theil_sen(std::span<const Vec2> points, const TheilSenOptions& options) {
  const auto slope = theil_sen_slope(points, options);
  if (!slope) return std::nullopt;
  const RegressionAxis axis = axis_of(points, options);
  std::vector<double> u;
  std::vector<double> offset;
  for (const Vec2 p : along_axis(points, axis)) {
    u.push_back(p.x);
    offset.push_back(p.y - *slope * p.x);
  }
  const Line line = line_of(axis, median(u).value(), *slope, median(offset).value());
  return measured(line, points, {}, weights_or_ones({}, points.size()));
}

std::optional<double> theil_sen_slope(std::span<const Vec2> points, const TheilSenOptions& options) {
  auto slopes = pair_slopes(points, options);
  return slopes ? slopes->median() : std::nullopt;
}

std::vector<double> sampled_slopes(std::span<const Vec2> points, std::size_t count, std::uint64_t seed,
                                   const TheilSenOptions& options) {
  const auto slopes = pair_slopes(points, options);
  return slopes ? slopes->sample(count, seed) : std::vector<double>{};
}

std::optional<SlopeInterval> slope_spread95(std::span<const Vec2> points, const TheilSenOptions& options) {
  auto slopes = pair_slopes(points, options);
  if (!slopes) return std::nullopt;
  const double last = static_cast<double>(slopes->size() - 1);
  return between(*slopes, 0.025 * last, 0.975 * last);
}

std::optional<SlopeInterval> ci_sen(std::span<const Vec2> points, const TheilSenOptions& options) {
  auto slopes = pair_slopes(points, options);
  if (!slopes) return std::nullopt;
  const double n = static_cast<double>(points.size());
  const double c = kZ95 * std::sqrt(n * (n - 1.0) * (2.0 * n + 5.0) / 18.0);
  const double m = static_cast<double>(slopes->size());
  return between(*slopes, std::round((m - c) / 2.0) - 1.0, std::round((m + c) / 2.0));
}

std::optional<SlopeInterval> ci_bootstrap599(std::span<const Vec2> points, std::uint64_t seed,
                                             const TheilSenOptions& options) {
  if (!pair_slopes(points, options)) return std::nullopt;
  const std::vector<Vec2> uv = along_axis(points, axis_of(points, options));
  RandomSequence random(seed);
  std::vector<Vec2> resample(uv.size());
  std::vector<double> slopes;
  for (std::size_t i = 0; i < kResamples; ++i) {
    std::ranges::generate(resample, [&] { return uv[random.below(uv.size())]; });
    if (const auto slope = PairSlopes(resample, options.min_step_m).median()) slopes.push_back(*slope);
  }
  if (slopes.empty()) return std::nullopt;
  std::ranges::sort(slopes);
  const std::size_t cut = std::min(kCutOff, (slopes.size() - 1) / 2);
  return SlopeInterval{slopes[cut], slopes[slopes.size() - 1 - cut]};
}

}  // namespace verge::fit
