// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/fit/bspline_interpolation.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <functional>
#include <utility>
#include <vector>

#include "verge/fit/banded.hpp"

namespace verge::fit {
namespace {

/// Schoenberg-Whitney: the system has one solution if and only if N_{k,p}(u_k) > 0 for every k.
bool is_determined(std::span<const double> u, std::span<const double> knots, std::size_t degree) {
  for (std::size_t k = 0; k < u.size(); ++k) {
    const BasisRow row = basis_row(knots, degree, u[k]);
    if (k < row.first || k > row.first + degree || !(row.values[k - row.first] > 0.0)) return false;
  }
  return true;
}

/// Inverse control points: N_{i,p}(u_k) P_i = Q_k. Row k has no entry further than p from the diagonal.
std::optional<std::vector<Vec2>> inverse_control_points(std::span<const Vec2> q, std::span<const double> u,
                                                        std::span<const double> knots, std::size_t degree) {
  BandedMatrix n(q.size(), degree);
  for (std::size_t k = 0; k < q.size(); ++k) {
    const BasisRow row = basis_row(knots, degree, u[k]);
    for (std::size_t j = 0; j <= degree; ++j) n.at(k, row.first + j) = row.values[j];
  }
  return solve(std::move(n), {q.begin(), q.end()});
}

}  // namespace

std::optional<BSpline> interpolate(std::span<const Vec2> key_points, const InterpolationOptions& options) {
  assert(options.degree >= 1 && options.degree <= kMaxDegree);
  const auto u = parameters(key_points, options.parameterization);
  if (!u || std::ranges::adjacent_find(*u, std::greater_equal{}) != u->end()) return std::nullopt;
  const std::size_t degree = std::min(options.degree, key_points.size() - 1);
  std::vector<double> knots = options.knots == KnotPlacement::kAveraged
                                  ? averaged_knots(*u, degree)
                                  : uniform_knots(key_points.size(), degree);
  if (!is_determined(*u, knots, degree)) return std::nullopt;
  auto control = inverse_control_points(key_points, *u, knots, degree);
  if (!control) return std::nullopt;
  return BSpline{degree, std::move(knots), std::move(*control)};
}

}  // namespace verge::fit
