// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/detect/gradient/curve.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "verge/fit/bspline.hpp"
#include "verge/fit/bspline_interpolation.hpp"
#include "verge/fit/bspline_least_squares.hpp"
#include "verge/fit/curvature.hpp"
#include "verge/fit/line.hpp"
#include "verge/fit/path.hpp"

namespace verge::detect::gradient {
namespace {

constexpr double kScaleFloor = 0.02;  // metres: feet are no better known than this

/// The line's points from the first to the last station that was fitted, in the order of the points.
Curve straight(const fit::Line& line, std::span<const Vec2> points, double step) {
  double first = fit::station(line, points.front());
  double last = first;
  for (const Vec2 p : points) {
    first = std::min(first, fit::station(line, p));
    last = std::max(last, fit::station(line, p));
  }
  const bool forward = fit::station(line, points.front()) <= fit::station(line, points.back());
  if (!forward) std::swap(first, last);
  const int n = std::max(1, static_cast<int>(std::ceil(std::abs(last - first) / step)));
  Curve curve;
  for (int i = 0; i <= n; ++i) curve.points.push_back(fit::point_at(line, first + (last - first) * i / n));
  return curve;
}

/// The cubic B-spline through the key points.
std::optional<Curve> through(const std::vector<Vec2>& key_points, fit::InterpolationOptions options,
                             double step) {
  auto spline = fit::interpolate(key_points, options);
  if (!spline && options.knots == fit::KnotPlacement::kUniform) {
    options.knots = fit::KnotPlacement::kAveraged;
    spline = fit::interpolate(key_points, options);
  }
  if (!spline) return std::nullopt;
  Curve curve{Model::kSpline, fit::sample(*spline, step), {}, key_points, {},
              spline->knots,  spline->control_points};
  curve.u = fit::parameters(key_points, options.parameterization).value_or(std::vector<double>{});
  return curve;
}

std::vector<Vec2> without_duplicates(std::span<const Vec2> points) {
  return fit::gather(points, fit::drop_duplicates(points));
}

/// The key points and, where they lie farther apart than `gap_m`, samples between them: where the curvature
/// is even, nothing else would hold the interpolating curve.
std::vector<std::size_t> with_gaps_filled(const std::vector<std::size_t>& key,
                                          const std::vector<Vec2>& samples, double gap_m) {
  const std::vector<double> arc = fit::arc_lengths(samples);
  std::vector<std::size_t> filled{key.front()};
  for (std::size_t k = 1; k < key.size(); ++k) {
    const std::size_t from = key[k - 1];
    const auto parts = static_cast<std::size_t>(std::ceil((arc[key[k]] - arc[from]) / gap_m));
    for (std::size_t part = 1; part < parts; ++part) filled.push_back(from + (key[k] - from) * part / parts);
    filled.push_back(key[k]);
  }
  return filled;
}

/// The least-squares spline near all points has few control points.
fit::SplineFitOptions near_all(fit::KnotPlacement knots, const GradientConfig& config) {
  constexpr double kSparse = 0.1;  // metres: a lower floor takes the few feet far out for outliers
  fit::SplineFitOptions options;
  options.span_m = config.spline_span_m;
  options.penalty = config.spline_penalty;
  options.knots = knots;
  options.robust = fit::RobustOptions{};
  options.robust->scale_floor_m = kSparse;
  return options;
}

/// III-2 on a smoothed boundary of that curvature.
std::vector<Vec2> key_points_of(const std::vector<Vec2>& samples, const std::vector<double>& kappa,
                                const GradientConfig& config) {
  const auto key = fit::smoothed_key_points(samples, kappa, config.key_window_m);
  return without_duplicates(fit::gather(samples, with_gaps_filled(key, samples, config.spline_span_m)));
}

/// n ln(RSS / n) + k ln n. Feet are no better known than kScaleFloor: below it no curve is better.
double bic(const fit::Residuals& residuals, std::size_t parameters) {
  const auto n = static_cast<double>(residuals.signed_m.size());
  const double deviation = std::max(residuals.rms_m, kScaleFloor);
  return 2.0 * n * std::log(deviation) + static_cast<double>(parameters) * std::log(n);
}

/// P3's "adaptive selection". Of a B-spline's coordinates those across it count, one a control point.
bool is_straight(const fit::LineFit& line, const std::vector<Vec2>& points, const GradientConfig& config) {
  if (config.straight_by == StraightRule::kResidual) return line.residuals.p95_m <= config.line_residual_m;
  const auto spline = fit::fit_spline(points, near_all(config.knots, config));
  return !spline || bic(line.residuals, 2) <= bic(spline->residuals, spline->curve.control_points.size());
}

/// Keeps the curvature of the points that key points were chosen from, and where along them all of these lie:
/// key points are some of them, in order.
void note_curvature(Curve& curve, std::vector<double> kappa, const std::vector<Vec2>& points) {
  curve.kappa = std::move(kappa);
  curve.s = fit::arc_lengths(points);
  for (std::size_t i = 0; i < points.size() && curve.key_s.size() < curve.key_points.size(); ++i) {
    if (points[i] == curve.key_points[curve.key_s.size()]) curve.key_s.push_back(curve.s[i]);
  }
}

/// III-2 to III-5: key points on the curve that smooths the boundary, and the B-spline through them.
std::optional<Curve> through_key_points(const std::vector<Vec2>& points, const GradientConfig& config) {
  constexpr double kSample = 0.25;  // metres
  const auto smooth = fit::spline_near(points, near_all(fit::KnotPlacement::kUniform, config));
  const std::vector<Vec2> samples = smooth ? fit::sample(*smooth, kSample) : points;
  auto kappa = fit::smoothed_curvature(samples, config.key_window_m);
  fit::InterpolationOptions options;
  options.knots = config.knots;
  auto curve = through(key_points_of(samples, kappa, config), options, config.sample_step_m);
  if (curve) note_curvature(*curve, std::move(kappa), samples);
  return curve;
}

/// Ours: few control points near all points.
std::optional<Curve> least_squares_curve(const std::vector<Vec2>& points, const GradientConfig& config) {
  const auto spline = fit::spline_near(points, near_all(config.knots, config));
  if (!spline) return std::nullopt;
  Curve curve{Model::kSpline,        fit::sample(*spline, config.sample_step_m), {}, {}, {}, spline->knots,
              spline->control_points};
  note_curvature(curve, fit::smoothed_curvature(curve.points, config.key_window_m), curve.points);
  return curve;
}

}  // namespace

std::optional<Curve> fit_curve(std::span<const Vec2> points, const GradientConfig& config) {
  fit::RobustOptions robust;
  robust.scale_floor_m = kScaleFloor;
  const auto line = fit::fit_line_robust(points, robust);
  if (!line) return std::nullopt;
  const std::vector<Vec2> distinct = without_duplicates(points);
  if (is_straight(*line, distinct, config)) return straight(line->line, points, config.sample_step_m);
  auto curve = config.spline == SplineKind::kKeyPoints ? through_key_points(distinct, config)
                                                       : least_squares_curve(distinct, config);
  return curve ? std::move(curve) : straight(line->line, points, config.sample_step_m);
}

std::optional<Curve> fit_curve_as_printed(std::span<const Vec2> points, const GradientConfig& config) {
  const std::vector<Vec2> ordered =
      without_duplicates(fit::gather(points, fit::order_along(points, {1.0, 0.0})));
  const auto line = fit::fit_line_ordinary(ordered);
  if (!line) return std::nullopt;
  if (line->residuals.p95_m <= config.line_residual_m)
    return straight(line->line, ordered, config.sample_step_m);
  const std::vector<double> kappa = fit::curvature(ordered);
  const std::vector<Vec2> key_points = fit::gather(ordered, fit::key_points(kappa));
  fit::InterpolationOptions options;
  options.parameterization = fit::Parameterization::kChordLength;
  auto curve = through(key_points, options, config.sample_step_m);
  if (curve) note_curvature(*curve, kappa, ordered);
  return curve;
}

}  // namespace verge::detect::gradient
