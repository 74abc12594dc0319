// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/fit/polynomial.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>
#include <utility>

#include <Eigen/Dense>

#include "verge/core/random.hpp"
#include "verge/fit/finite.hpp"

namespace verge::fit {
namespace {

using Eigen::Index;

/// What rounding alone may leave of a column, of its own length: its powers are then those of lower degrees.
constexpr double kSingular = 1e-13;

struct Extent {
  double low = 0.0;
  double high = 0.0;
  [[nodiscard]] double middle() const { return std::midpoint(low, high); }
  [[nodiscard]] double half() const { return 0.5 * (high - low); }
};

/// What is asked of a fit.
struct Request {
  std::span<const double> weights = {};
  std::size_t degree = 0;
  double ridge = 0.0;
  std::optional<double> tolerance = std::nullopt;  ///< None: the degree as it is.
};

/// Those of the values whose point weighs anything.
std::vector<double> weighing(std::span<const Vec2> points, std::span<const double> weights,
                             double Vec2::*value) {
  std::vector<double> values;
  values.reserve(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (weight_at(weights, i) > 0.0) values.push_back(points[i].*value);
  }
  return values;
}

/// How many different values there are; counting ends at `most`, which few values take to reach.
std::size_t count_distinct(std::span<const double> values, std::size_t most) {
  std::vector<double> seen;
  for (std::size_t i = 0; i < values.size() && seen.size() < most; ++i) {
    if (std::ranges::find(seen, values[i]) == seen.end()) seen.push_back(values[i]);
  }
  return seen.size();
}

Extent extent_of(std::span<const double> values) {
  const auto [low, high] = std::ranges::minmax(values);
  return {low, high};
}

/// The weighted least-squares system of all degrees up to one, decomposed once. The last column is y: what R
/// holds there in row k is how much T_k takes off the residuals.
class NestedSystem {
 public:
  NestedSystem(std::span<const Vec2> points, Extent x, Extent y, const Request& request);

  /// The highest degree that rounding does not decide.
  [[nodiscard]] std::size_t sound_degree() const;
  /// The weighted sum of squares that the polynomial of that degree leaves.
  [[nodiscard]] double left_over(std::size_t degree) const;
  [[nodiscard]] std::vector<double> coefficients(std::size_t degree) const;

 private:
  [[nodiscard]] auto right() const { return r_.col(r_.cols() - 1); }

  Eigen::MatrixXd r_;
};

NestedSystem::NestedSystem(std::span<const Vec2> points, Extent x, Extent y, const Request& request) {
  const auto n = static_cast<Index>(points.size());
  const auto degree = static_cast<Index>(request.degree);
  const Index penalties = request.ridge > 0.0 ? degree : 0;
  Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(n + penalties, degree + 2);
  Eigen::ArrayXd t(n);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto row = static_cast<Index>(i);
    const double root = std::sqrt(weight_at(request.weights, i));
    t(row) = (points[i].x - x.middle()) / x.half();
    rows(row, 0) = root;
    rows(row, degree + 1) = root * (points[i].y - y.middle());
  }
  for (Index k = 1; k <= degree; ++k) {  // T_k = 2 t T_{k-1} - T_{k-2}, T_1 = t T_0
    rows.col(k).head(n) = (k == 1 ? 1.0 : 2.0) * t * rows.col(k - 1).head(n).array();
    if (k > 1) rows.col(k).head(n) -= rows.col(k - 2).head(n);
  }
  for (Index k = 0; k < penalties; ++k) rows(n + k, k + 1) = std::sqrt(request.ridge);
  const Eigen::HouseholderQR<Eigen::Ref<Eigen::MatrixXd>> qr(rows);  // in place
  r_ = rows.topRows(std::min(rows.rows(), rows.cols())).triangularView<Eigen::Upper>();
}

std::size_t NestedSystem::sound_degree() const {
  Index sound = 0;
  while (sound + 2 < r_.cols() && std::abs(r_(sound + 1, sound + 1)) > kSingular * r_.col(sound + 1).norm()) {
    ++sound;
  }
  return static_cast<std::size_t>(sound);
}

double NestedSystem::left_over(std::size_t degree) const {
  return right().tail(r_.rows() - 1 - static_cast<Index>(degree)).squaredNorm();
}

std::vector<double> NestedSystem::coefficients(std::size_t degree) const {
  const auto size = static_cast<Index>(degree) + 1;
  const Eigen::VectorXd c =
      r_.topLeftCorner(size, size).triangularView<Eigen::Upper>().solve(right().head(size));
  return {c.begin(), c.end()};
}

/// The least degree whose residuals have at most that RMS; without one, the greatest.
std::size_t least_degree(const NestedSystem& system, std::size_t most, double rms_m, double total_weight) {
  for (std::size_t degree = 1; degree < most; ++degree) {
    if (std::sqrt(system.left_over(degree) / total_weight) <= rms_m) return degree;
  }
  return most;
}

double total_of(std::span<const double> weights, std::size_t size) {
  return weights.empty() ? static_cast<double>(size) : std::accumulate(weights.begin(), weights.end(), 0.0);
}

std::optional<Polynomial> solved(std::span<const Vec2> points, Request request) {
  assert(request.weights.empty() || request.weights.size() == points.size());
  if (!all_finite(points)) return std::nullopt;
  const std::vector<double> xs = weighing(points, request.weights, &Vec2::x);
  const std::size_t distinct = count_distinct(xs, std::max<std::size_t>(2, request.degree + 1));
  if (distinct < 2) return std::nullopt;
  if (!(request.ridge > 0.0)) request.degree = std::min(request.degree, distinct - 1);
  const Extent x = extent_of(xs);
  const Extent y = extent_of(weighing(points, request.weights, &Vec2::y));
  const NestedSystem system(points, x, y, request);
  std::size_t degree = system.sound_degree();
  if (request.tolerance) {
    const double total = total_of(request.weights, points.size());
    degree = least_degree(system, degree, *request.tolerance * y.half(), total);
  }
  Polynomial polynomial{x.middle(), x.half(), system.coefficients(degree)};
  polynomial.chebyshev_m[0] += y.middle();
  return polynomial;
}

PolynomialFit measured(Polynomial curve, std::span<const Vec2> points, std::span<const double> weights) {
  std::vector<double> above(points.size());
  std::ranges::transform(points, above.begin(), [&](Vec2 p) { return p.y - value_at(curve, p.x); });
  return {std::move(curve), summarise(std::move(above), weights), weights_or_ones(weights, points.size())};
}

/// A polynomial through `fitted`, measured at `points`.
std::optional<PolynomialFit> fit(std::span<const Vec2> fitted, std::span<const Vec2> points,
                                 const Request& request) {
  auto curve = solved(fitted, request);
  if (!curve) return std::nullopt;
  return measured(std::move(*curve), points, request.weights);
}

std::vector<Vec2> jittered(std::span<const Vec2> points, const PolynomialOptions& options) {
  std::vector<Vec2> moved(points.begin(), points.end());
  if (moved.empty()) return moved;
  const auto [left, right] = std::ranges::minmax(points, {}, &Vec2::x);
  const double most = options.jitter * 0.5 * (right.x - left.x);
  RandomSequence random(options.seed);
  for (Vec2& p : moved) p.x += most * (2.0 * random.uniform() - 1.0);
  return moved;
}

std::optional<PolynomialFit> fit_gated(std::span<const Vec2> points, const PolynomialOptions& options) {
  std::vector<double> weights(points.size(), 1.0);
  auto kept = fit_polynomial(points, options.degree);
  while (kept) {
    bool dropped = false;
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (weights[i] == 0.0 || std::abs(kept->residuals.signed_m[i]) <= options.gate_m) continue;
      weights[i] = 0.0;
      dropped = true;
    }
    auto next = dropped ? fit_polynomial(points, options.degree, weights) : std::nullopt;
    if (!next) break;  // nothing to drop, or too little left: the fit before stands
    kept = std::move(next);
  }
  return kept;
}

/// p t, for a polynomial p of x in ascending powers.
std::vector<double> times_t(std::span<const double> p, const Polynomial& scale) {
  std::vector<double> product(p.size() + 1, 0.0);
  for (std::size_t i = 0; i < p.size(); ++i) {
    product[i] -= p[i] * scale.middle_m / scale.half_m;
    product[i + 1] += p[i] / scale.half_m;
  }
  return product;
}

}  // namespace

double value_at(const Polynomial& polynomial, double x) {
  const double t = (x - polynomial.middle_m) / polynomial.half_m;
  const std::vector<double>& c = polynomial.chebyshev_m;
  double b1 = 0.0;
  double b2 = 0.0;
  for (std::size_t k = c.size() - 1; k > 0; --k) b2 = std::exchange(b1, c[k] + 2.0 * t * b1 - b2);
  return c[0] + t * b1 - b2;
}

std::vector<double> power_coefficients(const Polynomial& polynomial) {
  const std::vector<double>& c = polynomial.chebyshev_m;
  std::vector<double> b1{0.0};
  std::vector<double> b2{0.0};
  for (std::size_t k = c.size(); k-- > 0;) {  // Clenshaw's recurrence as in value_at, on polynomials
    std::vector<double> b = times_t(b1, polynomial);
    for (double& v : b) v *= k == 0 ? 1.0 : 2.0;
    for (std::size_t i = 0; i < b2.size(); ++i) b[i] -= b2[i];
    b[0] += c[k];
    b2 = std::exchange(b1, std::move(b));
  }
  b1.resize(c.size());
  std::ranges::reverse(b1);
  return b1;
}

std::optional<PolynomialFit> fit_polynomial(std::span<const Vec2> points, std::size_t degree,
                                            std::span<const double> weights) {
  return fit(points, points, {.weights = weights, .degree = degree});
}

std::optional<PolynomialFit> fit_polynomial_to(std::span<const Vec2> points, double tolerance,
                                               std::size_t max_degree) {
  return fit(points, points, {.weights = {}, .degree = max_degree, .tolerance = tolerance});
}

std::optional<PolynomialFit> fit_polynomial_with(std::span<const Vec2> points,
                                                 const PolynomialOptions& options) {
  switch (options.reading) {
    case StatedError::kTolerance:
      return fit_polynomial_to(points, options.tolerance, options.degree);
    case StatedError::kJitter:
      return fit(jittered(points, options), points, {.degree = options.degree});
    case StatedError::kRidge:
      return fit(points, points, {.degree = options.degree, .ridge = options.ridge});
    case StatedError::kSigma: {
      const std::vector<double> weights(points.size(), 1.0 / (options.sigma_m * options.sigma_m));
      return fit_polynomial(points, options.degree, weights);
    }
    case StatedError::kGate:
      return fit_gated(points, options);
    case StatedError::kNone:
      break;
  }
  return fit_polynomial(points, options.degree);
}

}  // namespace verge::fit
