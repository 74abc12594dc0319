// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "verge/core/vec.hpp"
#include "verge/fit/bspline.hpp"
#include "verge/fit/knots.hpp"
#include "verge/fit/residuals.hpp"
#include "verge/fit/robust.hpp"

namespace verge::fit {

/// The control points P that make  sum_k w_k |C(u_k) - Q_k|^2 + penalty |D^2 P|^2  least, for the points Q_k
/// at the given parameters and clamped knots. D^2 P are the second differences of the control points, taken
/// over the Greville abscissae so that a straight line run through at even speed costs nothing whatever the
/// knots (P-spline after Eilers and Marx 1996). `weights`: empty, or one finite weight >= 0 for each point.
/// None where the system is singular: with penalty 0, a knot span without points; or all weights 0. O(n p^2).
[[nodiscard]] std::optional<BSpline> least_squares_spline(std::span<const Vec2> points,
                                                          std::span<const double> weights,
                                                          std::span<const double> parameters,
                                                          std::vector<double> knots, std::size_t degree,
                                                          double penalty);

struct SplineFitOptions {
  std::size_t degree = 3;  ///< Lowered where the points are too few.
  double span_m = 3.0;     ///< Length of a knot span along the curve: shorter follows tighter bends.
  double penalty = 0.1;    ///< Weight of the second differences: more is straighter.
  KnotPlacement knots = KnotPlacement::kUniform;
  std::optional<RobustOptions> robust = std::nullopt;  ///< None: plain least squares.
};

struct SplineFit {
  BSpline curve;
  Residuals residuals;          ///< Orthogonal distances.
  std::vector<double> weights;  ///< What each point weighed in the end.
};

/// Cubic B-spline with few control points through noisy points, by penalised least squares (ours; the paper
/// interpolates its key points, which fits the noise). First the points' stations along their principal axis
/// are their parameters, with a knot span every `span_m`, and least_squares_spline is solved, again and again
/// with the weights renewed from the normal residuals if `robust`. Then once more with the arc lengths of the
/// points' feet on that curve, so that the knots are evenly spread along it however it bends. The points need
/// no order; the curve runs from the end of the first point to that of the last, between the outermost points
/// that weigh anything. It must not turn back on the principal axis: no part of it may run more than about 80
/// degrees off the axis. None for fewer than 2 distinct points of positive weight, for coordinates that are
/// not finite, or where least_squares_spline gives none.
[[nodiscard]] std::optional<SplineFit> fit_spline(std::span<const Vec2> points,
                                                  const SplineFitOptions& options = {},
                                                  std::span<const double> weights = {});

/// The curve of fit_spline alone, for those who need no residuals: finding the points' feet is a third of it.
[[nodiscard]] std::optional<BSpline> spline_near(std::span<const Vec2> points,
                                                 const SplineFitOptions& options = {},
                                                 std::span<const double> weights = {});

}  // namespace verge::fit
