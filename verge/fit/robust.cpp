// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/fit/robust.hpp"

#include <algorithm>
#include <cmath>

#include "verge/core/statistics.hpp"
#include "verge/fit/residuals.hpp"

namespace verge::fit {

double robust_scale(std::span<const double> residuals_m, std::span<const double> weights, double floor_m) {
  std::vector<double> absolute;
  absolute.reserve(residuals_m.size());
  for (std::size_t i = 0; i < residuals_m.size(); ++i) {
    if (weight_at(weights, i) > 0.0) absolute.push_back(std::abs(residuals_m[i]));
  }
  constexpr double kMadToSigma = 1.4826;  // 1 / the 75th percentile of the standard normal distribution
  return std::max(floor_m, kMadToSigma * median(absolute).value_or(0.0));
}

std::vector<double> tukey_weights(std::span<const double> residuals_m, std::span<const double> weights,
                                  const RobustOptions& options) {
  const double reach = options.tuning * robust_scale(residuals_m, weights, options.scale_floor_m);
  std::vector<double> out(residuals_m.size());
  for (std::size_t i = 0; i < out.size(); ++i) {
    const double t = residuals_m[i] / reach;
    const double inside = std::max(0.0, 1.0 - t * t);
    out[i] = weight_at(weights, i) * inside * inside;
  }
  return out;
}

std::vector<double> absolute_weights(std::span<const double> residuals_m, std::span<const double> weights,
                                     const RobustOptions& options) {
  std::vector<double> out(residuals_m.size());
  for (std::size_t i = 0; i < out.size(); ++i)
    out[i] = weight_at(weights, i) / std::max(std::abs(residuals_m[i]), options.scale_floor_m);
  return out;
}

std::vector<double> robust_weights(int iteration, std::span<const double> residuals_m,
                                   std::span<const double> weights, const RobustOptions& options) {
  return iteration < options.start_iterations ? absolute_weights(residuals_m, weights, options)
                                              : tukey_weights(residuals_m, weights, options);
}

}  // namespace verge::fit
