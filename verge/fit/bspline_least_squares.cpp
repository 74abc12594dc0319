// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/fit/bspline_least_squares.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <utility>

#include "verge/fit/banded.hpp"
#include "verge/fit/path.hpp"

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

/// D^2 P, scaled so that evenly spaced abscissae give P_{i-1} - 2 P_i + P_{i+1}.
void add_penalty(NormalEquations& sum, std::span<const double> knots, std::size_t degree, double penalty) {
  const std::vector<double> xi = greville(knots, degree);
  const double mean_step = (xi.back() - xi.front()) / static_cast<double>(xi.size() - 1);
  for (std::size_t i = 1; i + 1 < xi.size(); ++i) {
    const double before = mean_step / (xi[i] - xi[i - 1]);
    const double after = mean_step / (xi[i + 1] - xi[i]);
    add_equation(sum, i - 1, std::array{before, -before - after, after}, 3, penalty, {});
  }
}

/// Signed distance of each point from the curve's tangent at its parameter.
std::vector<double> normal_residuals(const BSpline& curve, std::span<const Vec2> points,
                                     std::span<const double> u) {
  const BSpline tangent = derivative(curve);
  std::vector<double> out;
  out.reserve(points.size());
  for (std::size_t k = 0; k < points.size(); ++k) {
    const Vec2 velocity = evaluate(tangent, u[k]);
    const Vec2 offset = points[k] - evaluate(curve, u[k]);
    const double speed = norm(velocity);
    out.push_back(speed > 0.0 ? cross(velocity, offset) / speed : norm(offset));
  }
  return out;
}

/// Distance of each point from its foot on the curve, with the side it lies on as its sign.
std::vector<double> orthogonal_residuals(const BSpline& curve, std::span<const Vec2> points) {
  const std::vector<double> u = nearest_parameters(curve, points);
  std::vector<double> out = normal_residuals(curve, points, u);
  for (std::size_t k = 0; k < points.size(); ++k)
    out[k] = std::copysign(distance(points[k], evaluate(curve, u[k])), out[k]);
  return out;
}

/// One span every `span_m` of length, at least one, and no more control points than points.
std::size_t control_point_count(double length_m, std::size_t degree, std::size_t points, double span_m) {
  const double most = static_cast<double>(points - degree);
  const double spans = std::clamp(std::round(length_m / span_m), 1.0, most);
  return static_cast<std::size_t>(spans) + degree;
}

std::vector<double> knots_for(std::span<const double> u, std::size_t control_points, std::size_t degree,
                              KnotPlacement placement) {
  return placement == KnotPlacement::kUniform ? uniform_knots(control_points, degree)
                                              : least_squares_knots(u, control_points, degree);
}

/// What stays the same through all rounds of one fit.
struct Problem {
  std::span<const Vec2> points;
  std::span<const double> weights;
  std::size_t degree;
  std::size_t control_points;
  const SplineFitOptions& options;
};

struct WeightedCurve {
  BSpline curve;
  std::vector<double> weights;
};

std::optional<WeightedCurve> solve_with(const Problem& problem, std::span<const double> u,
                                        std::vector<double> weights) {
  auto knots = knots_for(u, problem.control_points, problem.degree, problem.options.knots);
  auto curve = least_squares_spline(problem.points, weights, u, std::move(knots), problem.degree,
                                    problem.options.penalty);
  if (!curve) return std::nullopt;
  return WeightedCurve{std::move(*curve), std::move(weights)};
}

/// The robust iterations from `iteration` on, at fixed parameters.
WeightedCurve reweighted(const Problem& problem, std::span<const double> u, WeightedCurve best, int iteration,
                         const RobustOptions& robust) {
  for (int i = iteration; i < robust.start_iterations + robust.iterations; ++i) {
    const auto residuals = normal_residuals(best.curve, problem.points, u);
    auto next = solve_with(problem, u, robust_weights(i, residuals, problem.weights, robust));
    if (!next) break;  // too few points still weigh something: the curve before stands
    best = std::move(*next);
  }
  return best;
}

/// Round by round: solve, reweight, and move each point's parameter to its foot on the curve.
std::optional<WeightedCurve> solve_in_rounds(const Problem& problem, std::vector<double> u,
                                             std::vector<double> weights) {
  const auto& robust = problem.options.robust;
  for (int round = 0;; ++round) {
    auto fit = solve_with(problem, u, std::move(weights));
    if (!fit) return std::nullopt;
    const int first_iteration = round == 0 || !robust ? 0 : robust->start_iterations;
    if (robust) fit = reweighted(problem, u, std::move(*fit), first_iteration, *robust);
    if (round >= problem.options.projections) return fit;
    u = nearest_parameters(fit->curve, problem.points);
    weights = std::move(fit->weights);
  }
}

}  // namespace

std::optional<BSpline> least_squares_spline(std::span<const Vec2> points, std::span<const double> weights,
                                            std::span<const double> parameters, std::vector<double> knots,
                                            std::size_t degree, double penalty) {
  assert(parameters.size() == points.size() && (weights.empty() || weights.size() == points.size()));
  const std::size_t size = knots.size() - degree - 1;
  constexpr std::size_t kPenaltyBand = 2;
  NormalEquations sum{BandedMatrix(size, std::max(degree, kPenaltyBand)), std::vector<Vec2>(size)};
  for (std::size_t k = 0; k < points.size(); ++k) {
    const BasisRow row = basis_row(knots, degree, parameters[k]);
    add_equation(sum, row.first, row.values, degree + 1, weight_at(weights, k), points[k]);
  }
  add_penalty(sum, knots, degree, penalty);
  auto control = solve(std::move(sum.a), std::move(sum.b));
  if (!control) return std::nullopt;
  return BSpline{degree, std::move(knots), std::move(*control)};
}

std::optional<SplineFit> fit_spline(std::span<const Vec2> points, const SplineFitOptions& options,
                                    std::span<const double> weights) {
  assert(options.degree >= 1 && options.degree <= kMaxDegree && options.span_m > 0.0);
  const std::vector<Vec2> smooth = moving_mean(points, options.smoothing_m);
  auto u = parameters(smooth, Parameterization::kChordLength);
  if (!u) return std::nullopt;
  const std::size_t degree = std::min(options.degree, points.size() - 1);
  const double length_m = arc_lengths(smooth).back();
  const Problem problem{points, weights, degree,
                        control_point_count(length_m, degree, points.size(), options.span_m), options};
  auto fit = solve_in_rounds(problem, std::move(*u), weights_or_ones(weights, points.size()));
  if (!fit) return std::nullopt;
  auto residuals = summarise(orthogonal_residuals(fit->curve, points), weights);
  return SplineFit{std::move(fit->curve), std::move(residuals), std::move(fit->weights)};
}

}  // namespace verge::fit
