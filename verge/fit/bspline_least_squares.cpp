// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/fit/bspline_least_squares.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>
#include <utility>

#include "verge/fit/banded.hpp"
#include "verge/fit/line.hpp"

namespace verge::fit {
namespace {

/// The normal equations A P = B of the whole sum.
struct NormalEquations {
  BandedMatrix a;
  std::vector<Vec2> b;
};

/// Adds the weighted square of one equation, row . P = right, to the sum.
template <std::size_t N>
void add_equation(NormalEquations& sum, std::size_t first, const std::array<double, N>& row,
                  std::size_t terms, double weight, Vec2 right) {
  for (std::size_t i = 0; i < terms; ++i) {
    for (std::size_t j = 0; j < terms; ++j) sum.a.at(first + i, first + j) += weight * row[i] * row[j];
    sum.b[first + i] = sum.b[first + i] + (weight * row[i]) * right;
  }
}

/// Greville abscissae: a curve whose control points stand at L(xi_i), L linear, is the line L(u) itself.
std::vector<double> greville(std::span<const double> knots, std::size_t degree) {
  std::vector<double> xi;
  for (std::size_t i = 0; i + degree + 1 < knots.size(); ++i) {
    double sum = 0.0;
    for (std::size_t j = i + 1; j <= i + degree; ++j) sum += knots[j];
    xi.push_back(sum / static_cast<double>(degree));
  }
  return xi;
}

/// What P_{i-1}, P_i and P_{i+1} count for in a second difference.
using Bend = std::array<double, 3>;

/// D^2 P, scaled so that evenly spaced abscissae give P_{i-1} - 2 P_i + P_{i+1}.
std::vector<Bend> second_differences(std::span<const double> knots, std::size_t degree) {
  const std::vector<double> xi = greville(knots, degree);
  const double mean_step = (xi.back() - xi.front()) / static_cast<double>(xi.size() - 1);
  std::vector<Bend> bends;
  for (std::size_t i = 1; i + 1 < xi.size(); ++i) {
    const double before = mean_step / (xi[i] - xi[i - 1]);
    const double after = mean_step / (xi[i + 1] - xi[i]);
    bends.push_back({before, -before - after, after});
  }
  return bends;
}

/// What of a fit depends on the knots and parameters alone, made once for all its iterations.
struct Design {
  std::size_t degree;
  std::vector<double> knots;
  std::vector<BasisRow> position;  ///< For each parameter.
  std::vector<BasisRow> velocity;  ///< Of the derivative's knots and degree.
  std::vector<Bend> bends;
};

std::vector<BasisRow> rows_at(std::span<const double> knots, std::size_t degree, std::span<const double> u) {
  std::vector<BasisRow> rows(u.size());
  std::ranges::transform(u, rows.begin(), [&](double v) { return basis_row(knots, degree, v); });
  return rows;
}

Design design(std::vector<double> knots, std::size_t degree, std::span<const double> u) {
  auto position = rows_at(knots, degree, u);
  auto velocity = rows_at(std::span(knots).subspan(1, knots.size() - 2), degree - 1, u);
  auto bends = second_differences(knots, degree);
  return {degree, std::move(knots), std::move(position), std::move(velocity), std::move(bends)};
}

std::optional<BSpline> solve_design(const Design& at, std::span<const Vec2> points,
                                    std::span<const double> weights, double penalty) {
  const std::size_t size = at.knots.size() - at.degree - 1;
  constexpr std::size_t kPenaltyBand = 2;
  NormalEquations sum{BandedMatrix(size, std::max(at.degree, kPenaltyBand)), std::vector<Vec2>(size)};
  for (std::size_t k = 0; k < points.size(); ++k) {
    const BasisRow& row = at.position[k];
    add_equation(sum, row.first, row.values, at.degree + 1, weight_at(weights, k), points[k]);
  }
  for (std::size_t i = 0; i < at.bends.size(); ++i)
    add_equation(sum, i, at.bends[i], at.bends[i].size(), penalty, {});
  auto control = solve(std::move(sum.a), std::move(sum.b));
  if (!control) return std::nullopt;
  return BSpline{at.degree, at.knots, std::move(*control)};
}

/// Signed distance of each point from the curve's tangent at its parameter.
std::vector<double> normal_residuals(const BSpline& curve, const Design& at, std::span<const Vec2> points) {
  const BSpline tangent = derivative(curve);
  std::vector<double> out;
  out.reserve(points.size());
  for (std::size_t k = 0; k < points.size(); ++k) {
    const Vec2 velocity = combine(at.velocity[k], tangent.degree, tangent.control_points);
    const Vec2 offset = points[k] - combine(at.position[k], curve.degree, curve.control_points);
    const double speed = norm(velocity);
    out.push_back(speed > 0.0 ? cross(velocity, offset) / speed : norm(offset));
  }
  return out;
}

/// Distance of each point from its foot on the curve, with the side it lies on as its sign.
std::vector<double> orthogonal_residuals(const BSpline& curve, std::span<const Vec2> points) {
  const std::vector<double> u = nearest_parameters(curve, points);
  std::vector<double> out = normal_residuals(curve, design(curve.knots, curve.degree, u), points);
  for (std::size_t k = 0; k < points.size(); ++k)
    out[k] = std::copysign(distance(points[k], evaluate(curve, u[k])), out[k]);
  return out;
}

/// The parameter of each point, and how long the course is that they measure.
struct Stations {
  std::vector<double> u;
  double length_m;
};

/// Stations s, metres, made parameters: 0 and 1 are the outermost points that weigh anything.
std::optional<Stations> parameters_of(std::vector<double> s, std::span<const double> weights) {
  double from = std::numeric_limits<double>::infinity();
  double to = -from;
  for (std::size_t k = 0; k < s.size(); ++k) {
    if (!(weight_at(weights, k) > 0.0)) continue;
    from = std::min(from, s[k]);
    to = std::max(to, s[k]);
  }
  if (!(to > from)) return std::nullopt;
  for (double& value : s) value = std::clamp((value - from) / (to - from), 0.0, 1.0);
  return Stations{std::move(s), to - from};
}

/// By the points' principal axis: points that lie aside of the curve do not disturb it, as they would the
/// length of a path through the points.
std::optional<Stations> along_axis(std::span<const Vec2> points, std::span<const double> weights) {
  const auto axis = orthogonal_line(points, weights);
  if (!axis) return std::nullopt;
  const double sense = station(*axis, points.front()) <= station(*axis, points.back()) ? 1.0 : -1.0;
  std::vector<double> s(points.size());
  std::ranges::transform(points, s.begin(), [&](Vec2 p) { return sense * station(*axis, p); });
  return parameters_of(std::move(s), weights);
}

/// By the arc length of each point's foot on a curve.
std::optional<Stations> along_curve(const BSpline& curve, std::span<const Vec2> points,
                                    std::span<const double> weights) {
  return parameters_of(arc_lengths(curve, nearest_parameters(curve, points)), weights);
}

/// One span every `span_m` of length, at least one, and no more control points than points.
std::size_t control_point_count(double length_m, std::size_t degree, std::size_t points, double span_m) {
  const double most = static_cast<double>(points - degree);
  const double spans = std::clamp(std::round(length_m / span_m), 1.0, most);
  return static_cast<std::size_t>(spans) + degree;
}

std::vector<double> knots_for(std::vector<double> u, std::size_t control_points, std::size_t degree,
                              KnotPlacement placement) {
  if (placement == KnotPlacement::kUniform) return uniform_knots(control_points, degree);
  std::ranges::sort(u);
  return least_squares_knots(u, control_points, degree);
}

struct WeightedCurve {
  BSpline curve;
  std::vector<double> weights;
};

std::optional<WeightedCurve> solve_with(const Design& at, std::span<const Vec2> points,
                                        std::vector<double> weights, double penalty) {
  auto curve = solve_design(at, points, weights, penalty);
  if (!curve) return std::nullopt;
  return WeightedCurve{std::move(*curve), std::move(weights)};
}

/// What stays the same through all rounds of one fit.
struct Problem {
  std::span<const Vec2> points;
  std::span<const double> weights;
  const SplineFitOptions& options;
};

/// The curve at fixed parameters, starting from the weights `start`; if robust, with the iterations from
/// `iteration` on.
std::optional<WeightedCurve> solve_round(const Problem& problem, const Stations& stations,
                                         std::vector<double> start, int iteration) {
  const std::span<const Vec2> points = problem.points;
  const SplineFitOptions& options = problem.options;
  const std::size_t degree = std::min(options.degree, points.size() - 1);
  const std::size_t count = control_point_count(stations.length_m, degree, points.size(), options.span_m);
  const Design at = design(knots_for(stations.u, count, degree, options.knots), degree, stations.u);
  auto first = solve_with(at, points, std::move(start), options.penalty);
  if (!first || !options.robust) return first;
  WeightedCurve best = *std::move(first);
  for (int i = iteration; i < options.robust->start_iterations + options.robust->iterations; ++i) {
    const auto residuals = normal_residuals(best.curve, at, points);
    auto weights = robust_weights(i, residuals, problem.weights, *options.robust);
    auto next = solve_with(at, points, std::move(weights), options.penalty);
    if (!next) break;  // too few points still weigh something: the curve before stands
    best = *std::move(next);
  }
  return best;
}

/// Both rounds, by the axis and by the course.
std::optional<WeightedCurve> solve_rounds(const Problem& problem) {
  const SplineFitOptions& options = problem.options;
  assert(options.degree >= 1 && options.degree <= kMaxDegree && options.span_m > 0.0);
  const std::span<const Vec2> points = problem.points;
  const auto axis = along_axis(points, problem.weights);
  if (!axis) return std::nullopt;
  auto fit = solve_round(problem, *axis, weights_or_ones(problem.weights, points.size()), 0);
  if (!fit) return std::nullopt;
  const int after_start = options.robust ? options.robust->start_iterations : 0;
  if (const auto course = along_curve(fit->curve, points, fit->weights)) {
    if (auto again = solve_round(problem, *course, fit->weights, after_start)) fit = std::move(again);
  }
  return fit;
}

}  // namespace

std::optional<BSpline> least_squares_spline(std::span<const Vec2> points, std::span<const double> weights,
                                            std::span<const double> parameters, std::vector<double> knots,
                                            std::size_t degree, double penalty) {
  assert(parameters.size() == points.size() && (weights.empty() || weights.size() == points.size()));
  return solve_design(design(std::move(knots), degree, parameters), points, weights, penalty);
}

std::optional<SplineFit> fit_spline(std::span<const Vec2> points, const SplineFitOptions& options,
                                    std::span<const double> weights) {
  auto fit = solve_rounds({points, weights, options});
  if (!fit) return std::nullopt;
  auto residuals = summarise(orthogonal_residuals(fit->curve, points), weights);
  return SplineFit{std::move(fit->curve), std::move(residuals), std::move(fit->weights)};
}

std::optional<BSpline> spline_near(std::span<const Vec2> points, const SplineFitOptions& options,
                                   std::span<const double> weights) {
  auto fit = solve_rounds({points, weights, options});
  if (!fit) return std::nullopt;
  return std::move(fit->curve);
}

}  // namespace verge::fit
