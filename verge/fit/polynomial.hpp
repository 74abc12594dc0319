// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "verge/core/vec.hpp"
#include "verge/fit/residuals.hpp"

namespace verge::fit {

/// y as a polynomial of x, on Chebyshev's basis over the points' extent: high degrees are then as well
/// conditioned as the points allow, which powers of x in metres never are.
struct Polynomial {
  double middle_m = 0.0;  ///< t = (x - middle) / half lies in [-1, 1] at the points.
  double half_m = 1.0;
  std::vector<double> chebyshev_m;  ///< y = sum_k c_k T_k(t). Never empty.

  [[nodiscard]] std::size_t degree() const { return chebyshev_m.size() - 1; }
};

/// y at x (Clenshaw's recurrence). Beyond the points it soon means nothing.
[[nodiscard]] double value_at(const Polynomial& polynomial, double x);

/// p_1 .. p_{n+1} of paper 2, Eq. (3): y = p_1 x^n + p_2 x^(n-1) + ... + p_{n+1}, x in metres. Of high
/// degrees they are large, of both signs, and lose most of their digits: for reading, not for evaluating.
[[nodiscard]] std::vector<double> power_coefficients(const Polynomial& polynomial);

/// What paper 2 (V-C) may mean by "the method was modified by adding errors 10^3" (A1.4): its title says
/// "with a specified error", its sign of the exponent may be lost, its unit may be the millimetre.
enum class StatedError : std::uint8_t {
  kNone,       ///< Plain least squares of the degree that is asked for.
  kTolerance,  ///< The error is specified: the degree rises from 1 until the fit is that close (the default).
  kJitter,     ///< Added to x, so that no two are equal; the only reading in which the points' order counts.
  kRidge,      ///< Added to the squares: a penalty on the coefficients.
  kSigma,      ///< The deviation of every point, as weights. It is the same for all and changes nothing.
  kGate,  ///< The largest error: points beyond it are left out and the rest is fitted again, until none is.
};

struct PolynomialOptions {
  StatedError reading = StatedError::kTolerance;
  std::size_t degree = 16;  ///< The paper's n; of kTolerance the highest.
  double tolerance = 1e-3;  ///< kTolerance: RMS of the residuals over half of the points' extent in y.
  double jitter = 1e-3;     ///< kJitter: at most so much, over half of the extent in x.
  double ridge = 1e-3;      ///< kRidge: times the sum of squares of c_1, c_2, ...
  double sigma_m = 1.0;     ///< kSigma.
  double gate_m = 1.0;      ///< kGate.
  std::uint64_t seed = 0;   ///< kJitter.
};

struct PolynomialFit {
  Polynomial curve;
  Residuals residuals;  ///< Along y, as Eq. (4) has them, positive above the curve; figures of what weighs.
  std::vector<double> weights;  ///< What each point weighed in the end.
};

/// Polynomial of y on x by least squares (paper 2, Eq. (4)), by a QR decomposition. The degree is lowered to
/// the number of distinct x less one, and further where x are so close that rounding decides. `weights`:
/// empty, or one finite weight >= 0 for each point. O(n degree^2). Degenerate: fewer than 2 distinct x of
/// positive weight, or a coordinate that is not finite, give none.
[[nodiscard]] std::optional<PolynomialFit> fit_polynomial(std::span<const Vec2> points, std::size_t degree,
                                                          std::span<const double> weights = {});

/// The polynomial of the least degree, from 1 to `max_degree`, whose RMS residual is at most `tolerance`
/// times half of the points' extent in y (A1.4, reading 1: "with a specified error and a polynomial of
/// different degrees"); of `max_degree` where none is. All degrees come from one decomposition. Degenerate:
/// as fit_polynomial.
[[nodiscard]] std::optional<PolynomialFit> fit_polynomial_to(std::span<const Vec2> points,
                                                             double tolerance = 1e-3,
                                                             std::size_t max_degree = 16);

/// The paper's modified least squares, in any of its readings. With a ridge the degree is as asked for
/// whatever the points. Degenerate: as fit_polynomial.
[[nodiscard]] std::optional<PolynomialFit> fit_polynomial_with(std::span<const Vec2> points,
                                                               const PolynomialOptions& options);

}  // namespace verge::fit
