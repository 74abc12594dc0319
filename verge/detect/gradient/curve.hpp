// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "verge/core/vec.hpp"
#include "verge/detect/gradient/gradient.hpp"
#include "verge/model/scene.hpp"

namespace verge::detect::gradient {

/// A fitted boundary in the plane of the level frame.
struct Curve {
  Model model = Model::kLine;
  std::vector<Vec2>
      points;  ///< Samples along it, sample_step_m apart, in the order of the points it was fitted to.

  // Of a B-spline, under their names in the paper; empty for a line.
  std::vector<double> kappa;     ///< Curvature 1 / rho_i of the points that key points were chosen from, 1/m.
  std::vector<Vec2> key_points;  ///< Q_k
  std::vector<double> u;         ///< Parameters of the key points.
  std::vector<double> U;         ///< Knot vector.
  std::vector<Vec2> control_points;  ///< P_i
  std::vector<double> s{};           ///< Where each point of kappa lies along them, m from the first.
  std::vector<double> key_s{};       ///< Where the key points do; they are some of them.
};

/// III, fixed reading. A straight line by robust orthogonal least squares where the residuals' 95th
/// percentile is at most line_residual_m; else a cubic B-spline: the points are smoothed by a least-squares
/// spline first, since the highest curvatures of noisy points are the noisiest (A2.2-6); key points by the
/// curvature of that curve; centripetal parameters; averaged knots; inverse control points. `points` are in
/// order along the boundary. None for fewer than two distinct points.
[[nodiscard]] std::optional<Curve> fit_curve(std::span<const Vec2> points, const GradientConfig& config);

/// III, paper reading: least squares of y on x over the points as they are; else key points where the
/// curvature of the raw points is at least its mean, chord-length parameters (what the printed recursion says
/// but for its repeated sum), averaged knots, inverse control points. The points are ordered along the road.
/// None as above.
[[nodiscard]] std::optional<Curve> fit_curve_as_printed(std::span<const Vec2> points,
                                                        const GradientConfig& config);

}  // namespace verge::detect::gradient
