// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace verge::fit {

/// How far the points of a fit lie from its curve, metres.
struct Residuals {
  /// For each input point, in its order: the orthogonal distance to the curve, positive to the left of the
  /// curve's direction. (Of polynomials, along y.)
  std::vector<double> signed_m;
  /// Root of the weighted mean of squares.
  double rms_m = 0.0;
  /// 95th percentile of the distances without sign, over the points of positive weight, each counting once.
  double p95_m = 0.0;
};

/// The residuals with their two figures. `weights` as in the fits: empty, or one for each residual; at least
/// one must be positive.
[[nodiscard]] Residuals summarise(std::vector<double> signed_m, std::span<const double> weights);

/// The weight of point i, where no weights at all mean that every point weighs 1.
[[nodiscard]] inline double weight_at(std::span<const double> weights, std::size_t i) {
  return weights.empty() ? 1.0 : weights[i];
}

/// The weights, or `size` ones where there are none.
[[nodiscard]] std::vector<double> weights_or_ones(std::span<const double> weights, std::size_t size);

}  // namespace verge::fit
