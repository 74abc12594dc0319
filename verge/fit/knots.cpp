// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/fit/knots.hpp"

#include <cassert>
#include <cmath>

namespace verge::fit {
namespace {

/// p + 1 zeros, the interior knots interior(1) .. interior(n - p), and p + 1 ones.
template <class Interior>
std::vector<double> clamped(std::size_t control_points, std::size_t degree, Interior interior) {
  assert(degree >= 1 && control_points > degree);
  std::vector<double> knots(degree + 1, 0.0);
  for (std::size_t j = 1; j + degree < control_points; ++j) knots.push_back(interior(j));
  knots.insert(knots.end(), degree + 1, 1.0);
  return knots;
}

}  // namespace

std::optional<std::vector<double>> parameters(std::span<const Vec2> points, Parameterization kind) {
  std::vector<double> u(points.size(), 0.0);
  for (std::size_t k = 1; k < points.size(); ++k) {
    const double chord = distance(points[k - 1], points[k]);
    u[k] = u[k - 1] + (kind == Parameterization::kCentripetal ? std::sqrt(chord) : chord);
  }
  if (u.empty() || !(u.back() > 0.0) || !std::isfinite(u.back())) return std::nullopt;
  const double d = u.back();
  for (double& value : u) value /= d;  // the last is d / d, exactly 1
  return u;
}

std::vector<double> averaged_knots(std::span<const double> parameters, std::size_t degree) {
  return clamped(parameters.size(), degree, [&](std::size_t j) {
    double sum = 0.0;
    for (std::size_t i = j; i < j + degree; ++i) sum += parameters[i];
    return sum / static_cast<double>(degree);
  });
}

std::vector<double> uniform_knots(std::size_t control_points, std::size_t degree) {
  const double spans = static_cast<double>(control_points - degree);
  return clamped(control_points, degree, [&](std::size_t j) { return static_cast<double>(j) / spans; });
}

std::vector<double> least_squares_knots(std::span<const double> parameters, std::size_t control_points,
                                        std::size_t degree) {
  assert(control_points <= parameters.size());
  const double d = static_cast<double>(parameters.size()) / static_cast<double>(control_points - degree);
  return clamped(control_points, degree, [&](std::size_t j) {
    const double position = static_cast<double>(j) * d;
    const auto i = static_cast<std::size_t>(position);
    const double share = position - static_cast<double>(i);
    return (1.0 - share) * parameters[i - 1] + share * parameters[i];
  });
}

}  // namespace verge::fit
