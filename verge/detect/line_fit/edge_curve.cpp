// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/detect/line_fit/edge_curve.hpp"

#include <algorithm>
#include <utility>

#include "verge/fit/robust.hpp"
#include "verge/fit/theil_sen.hpp"

namespace verge::detect::line_fit {
namespace {

template <class Fit>
std::optional<Curve> line_of(const std::optional<Fit>& fitted) {
  return fitted ? std::optional<Curve>(fitted->line) : std::nullopt;
}

template <class Fit>
std::optional<Curve> curve_of(const std::optional<Fit>& fitted) {
  return fitted ? std::optional<Curve>(fitted->curve) : std::nullopt;
}

/// A cubic with its outliers weighed down, as fit_line_robust() weighs a line's.
std::optional<fit::PolynomialFit> fit_cubic_robust(std::span<const Vec2> points) {
  constexpr std::size_t kCubic = 3;
  const fit::RobustOptions options;
  auto fitted = fit::fit_polynomial(points, kCubic);
  for (int i = 0; fitted && i < options.start_iterations + options.iterations; ++i) {
    const auto weights = fit::robust_weights(i, fitted->residuals.signed_m, {}, options);
    auto next = fit::fit_polynomial(points, kCubic, weights);
    if (!next) break;
    fitted = std::move(next);
  }
  return fitted;
}

/// A cubic where it is so much closer than a line that the points themselves are curved.
std::optional<Curve> robust_curve(std::span<const Vec2> points, double line_p95_m) {
  constexpr std::size_t kLeast = 12;  // a cubic follows the noise of fewer
  constexpr double kCloser = 0.5;
  const auto line = fit::fit_line_robust(points);
  if (!line || points.size() < kLeast || line->residuals.p95_m <= line_p95_m) return line_of(line);
  const auto cubic = fit_cubic_robust(points);
  return cubic && cubic->residuals.p95_m < kCloser * line->residuals.p95_m ? curve_of(cubic) : line_of(line);
}

}  // namespace

double station_on(const Curve& curve, Vec2 place) {
  const auto* line = std::get_if<fit::Line>(&curve);
  return line != nullptr ? fit::station(*line, place) : place.x;
}

Vec2 place_on(const Curve& curve, double station_m) {
  if (const auto* line = std::get_if<fit::Line>(&curve)) return fit::point_at(*line, station_m);
  return {station_m, fit::value_at(std::get<fit::Polynomial>(curve), station_m)};
}

std::optional<Curve> estimate(std::span<const Vec2> points, EdgeEstimator estimator,
                              const LineFitConfig& config) {
  switch (estimator) {
    case EdgeEstimator::kRobust:
      return robust_curve(points, config.line_p95_m);
    case EdgeEstimator::kLeastSquares:
      return line_of(fit::fit_line_ordinary(points));
    case EdgeEstimator::kTheilSen:
      return line_of(config.is_printed() ? fit::fit_line_theil_sen(points, {.axis = fit::RegressionAxis::kX})
                                         : fit::fit_line_theil_sen(points));
    case EdgeEstimator::kPolynomial:
      return curve_of(config.is_printed()
                          ? fit::fit_polynomial_to(points)
                          : fit::fit_polynomial(points, static_cast<std::size_t>(config.degree)));
    case EdgeEstimator::kHough:
      break;  // many lines of one group: hough_lines()
  }
  return std::nullopt;
}

Edge edge_of(Curve curve, std::vector<std::size_t> points, std::span<const Vec2> places) {
  Edge edge{std::move(curve), std::move(points), 0.0, 0.0};
  const auto station = [&](std::size_t i) { return station_on(edge.curve, places[i]); };
  const auto [first, last] = std::ranges::minmax_element(edge.points, {}, station);
  edge.from_m = station(*first);
  edge.to_m = station(*last);
  return edge;
}

}  // namespace verge::detect::line_fit
