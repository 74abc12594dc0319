// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "verge/core/vec.hpp"

namespace verge::fit {

/// The basis function N_{i,m}(u) of order m >= 1 (degree m - 1) over the knots t, paper 3 Eq. (2) with its
/// misprinted second term put right:
///   N_{i,1}(u) = 1 for t_i <= u < t_{i+1}, else 0
///   N_{i,m}(u) = (u - t_i) / (t_{i+m-1} - t_i) N_{i,m-1}(u) + (t_{i+m} - u) / (t_{i+m} - t_{i+1})
///   N_{i+1,m-1}(u)
/// with 0/0 := 0, and the last span that is not empty closed, so that a clamped curve has its end point.
/// `t` must not decrease and reach t_{i+m}. The recursion as the paper writes it; curves use basis_row.
[[nodiscard]] double basis(std::span<const double> t, std::size_t i, std::size_t m, double u);

/// A B-spline curve in the plane, paper 3 Eq. (1): C(u) = sum_{i=0}^{n} P_i N_{i,m}(u), order m = degree + 1.
/// Holds n + 1 > degree control points and n + m + 1 knots that do not decrease. Its domain is
/// [t_degree, t_{n+1}], which must not be empty.
struct BSpline {
  std::size_t degree = 3;            ///< At most kMaxDegree. The paper's cubic: order 4, degree 3.
  std::vector<double> knots;         ///< t_0 .. t_{n+m}
  std::vector<Vec2> control_points;  ///< P_0 .. P_n, metres
};

inline constexpr std::size_t kMaxDegree = 5;

/// The degree + 1 basis functions that are not 0 at a parameter: N_first .. N_{first+degree}.
struct BasisRow {
  std::size_t first = 0;
  std::array<double, kMaxDegree + 1> values{};
};

/// Eq. (2) for all functions at once, lowest order first. `u` outside the domain is taken at its nearer end.
[[nodiscard]] BasisRow basis_row(std::span<const double> t, std::size_t degree, double u);

/// The control points weighed by a row: the point of the curve there.
[[nodiscard]] inline Vec2 combine(const BasisRow& row, std::size_t degree,
                                  std::span<const Vec2> control_points) {
  Vec2 point;
  for (std::size_t j = 0; j <= degree; ++j) point = point + row.values[j] * control_points[row.first + j];
  return point;
}

/// The curve's point at u; u outside the domain is taken at its nearer end.
[[nodiscard]] Vec2 evaluate(const BSpline& curve, double u);

/// The curve dC/du, of one degree less over the same domain. `degree` must be at least 1.
[[nodiscard]] BSpline derivative(const BSpline& curve);

/// Points on the curve from its first to its last, evenly spaced along it: the spacing is the greatest that
/// divides the length and is not above `step_m` (> 0; good to about 1 % of the step). Both ends are among
/// them; a curve without length gives one point.
[[nodiscard]] std::vector<Vec2> sample(const BSpline& curve, double step_m);

/// Arc length of the curve from its start to each of the parameters, metres (by 32 chords a span).
[[nodiscard]] std::vector<double> arc_lengths(const BSpline& curve, std::span<const double> parameters);

/// The curve's length, metres.
[[nodiscard]] double length(const BSpline& curve);

/// The parameter of the curve's point that is nearest to each of `points` (of equals, the least). The stretch
/// is chosen on a polyline of 16 chords a span, and the foot then found on the curve itself.
[[nodiscard]] std::vector<double> nearest_parameters(const BSpline& curve, std::span<const Vec2> points);

/// Which last row the matrix of Eq. (3) has.
enum class MatrixRow : std::uint8_t {
  kCorrected,  ///< 1 4 1 0: the weights sum to 1 for every u.
  kPrinted,    ///< 0 4 1 0: they sum to 5/6, so that the curve is drawn towards the origin.
};

/// The weights of p_{i-1}, p_i, p_{i+1}, p_{i+2} on one span of a uniform cubic B-spline, u in [0, 1]: paper
/// 3 Eq. (3). It holds for uniform knots only and does not pass through its points.
[[nodiscard]] std::array<double, 4> uniform_cubic_weights(double u, MatrixRow row = MatrixRow::kCorrected);

/// C(u) of Eq. (3).
[[nodiscard]] Vec2 uniform_cubic(std::span<const Vec2, 4> p, double u, MatrixRow row = MatrixRow::kCorrected);

}  // namespace verge::fit
