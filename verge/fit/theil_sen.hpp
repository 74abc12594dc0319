// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <numbers>
#include <optional>
#include <span>
#include <vector>

#include "verge/core/vec.hpp"
#include "verge/fit/line.hpp"

namespace verge::fit {

/// The axis that a regression runs along: slopes are dy/dx along x, and dx/dy along y.
enum class RegressionAxis : std::uint8_t { kX, kY };

/// The axis along which the points reach farther; x where both are equal, and of no points.
[[nodiscard]] RegressionAxis longer_axis(std::span<const Vec2> points);

struct TheilSenOptions {
  /// None: the longer axis of the points, so that a line along y is as good as one along x. The paper's
  /// slopes are dy/dx always (kX).
  std::optional<RegressionAxis> axis = std::nullopt;
  double min_step_m = 1e-3;  ///< Pairs that are less apart along the axis have no slope. Above 0.
};

/// The share of the points that may be anywhere before the slope can be anything (paper 2, V-B: 29.3 %): a
/// share e of bad points leaves (1 - e)^2 of the pairs good, and the median stands while that is above a
/// half.
inline constexpr double kTheilSenBreakdown = 1.0 - 0.5 * std::numbers::sqrt2;

/// Straight line by Theil and Sen (paper 2, III-B): its slope is the median of the slopes of all pairs of
/// points, its intercept the median of v - slope u, u along the axis. `centroid` is the line's point at the
/// median of u; the residuals are orthogonal. Exact, whatever the order of the points; see PairSlopes for its
/// cost. Degenerate: where no pair has a slope (fewer than 2 points, or all within min_step_m along the
/// axis), or a coordinate is not finite, none.
[[nodiscard]] std::optional<LineFit> fit_line_theil_sen(std::span<const Vec2> points,
                                                        const TheilSenOptions& options = {});

/// The slope alone. Degenerate: as fit_line_theil_sen.
[[nodiscard]] std::optional<double> theil_sen_slope(std::span<const Vec2> points,
                                                    const TheilSenOptions& options = {});

/// The slopes of `count` pairs drawn by chance, with repetition: what the paper says is enough (about 600).
/// Their median costs little and is less sure than that of all pairs. Degenerate: as fit_line_theil_sen, none
/// at all.
[[nodiscard]] std::vector<double> sampled_slopes(std::span<const Vec2> points, std::size_t count,
                                                 std::uint64_t seed, const TheilSenOptions& options = {});

struct SlopeInterval {
  double low = 0.0;
  double high = 0.0;
};

/// The middle 95 % of the slopes of all pairs, which the paper takes for a confidence interval (III-B). It is
/// none: it says how far pairs scatter, and does not shrink as points are added. Degenerate: as
/// fit_line_theil_sen.
[[nodiscard]] std::optional<SlopeInterval> slope_spread95(std::span<const Vec2> points,
                                                          const TheilSenOptions& options = {});

/// The 95 % confidence interval of the slope by Sen, "Estimates of the regression coefficient based on
/// Kendall's tau", Journal of the American Statistical Association 63 (1968): of M slopes in ascending order
/// those at (M - C) / 2 and (M + C) / 2 + 1, counted from 1, C = 1.96 sqrt(N (N - 1) (2 N + 5) / 18), or the
/// outermost ones. It holds for N points with distinct u and noise that is independent of u. Degenerate: as
/// fit_line_theil_sen.
[[nodiscard]] std::optional<SlopeInterval> ci_sen(std::span<const Vec2> points,
                                                  const TheilSenOptions& options = {});

/// The 95 % confidence interval of the slope from 599 resamples of the points (percentile bootstrap; Wilcox,
/// "Introduction to Robust Estimation and Hypothesis Testing"): the 16th least and the 16th greatest of their
/// slopes. It needs no assumption about the noise, and 599 times the time. Resamples without a slope do not
/// count. Degenerate: as fit_line_theil_sen, and none where no resample has one.
[[nodiscard]] std::optional<SlopeInterval> ci_bootstrap599(std::span<const Vec2> points, std::uint64_t seed,
                                                           const TheilSenOptions& options = {});

}  // namespace verge::fit
