// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

namespace verge::fit {

/// Iteratively reweighted least squares with Tukey's biweight. The number of iterations is fixed, so that the
/// result depends on the points alone.
struct RobustOptions {
  int start_iterations =
      10;               ///< First, towards least absolute residuals: a start that outliers do not carry off.
  int iterations = 10;  ///< Then with the biweight.
  double tuning =
      4.685;  ///< Residuals beyond tuning x scale weigh nothing (95 % efficient on Gaussian noise).
  double scale_floor_m =
      1e-3;  ///< The scale is never less: more than half of the points may lie exactly on the curve.
};

/// Scale of the residuals, metres: 1.4826 x median |r| over the points of positive weight (for Gaussian noise
/// its standard deviation), at least `floor_m`.
[[nodiscard]] double robust_scale(std::span<const double> residuals_m, std::span<const double> weights,
                                  double floor_m);

/// Tukey's biweight for each residual, (1 - (r / (tuning scale))^2)^2 inside and 0 outside, times the point's
/// own weight (`weights` empty: 1).
[[nodiscard]] std::vector<double> tukey_weights(std::span<const double> residuals_m,
                                                std::span<const double> weights,
                                                const RobustOptions& options);

/// 1 / max(|r|, scale_floor_m), times the point's own weight: repeated, it leads to least absolute residuals.
[[nodiscard]] std::vector<double> absolute_weights(std::span<const double> residuals_m,
                                                   std::span<const double> weights,
                                                   const RobustOptions& options);

/// The weights for iteration `iteration` (from 0): least absolute residuals first, then the biweight.
[[nodiscard]] std::vector<double> robust_weights(int iteration, std::span<const double> residuals_m,
                                                 std::span<const double> weights,
                                                 const RobustOptions& options);

}  // namespace verge::fit
