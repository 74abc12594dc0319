// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/fit/residuals.hpp"

#include <cassert>
#include <cmath>
#include <utility>

#include "verge/core/statistics.hpp"

namespace verge::fit {

Residuals summarise(std::vector<double> signed_m, std::span<const double> weights) {
  assert(weights.empty() || weights.size() == signed_m.size());
  double squares = 0.0;
  double total = 0.0;
  std::vector<double> counted;
  counted.reserve(signed_m.size());
  for (std::size_t i = 0; i < signed_m.size(); ++i) {
    const double w = weight_at(weights, i);
    squares += w * signed_m[i] * signed_m[i];
    total += w;
    if (w > 0.0) counted.push_back(std::abs(signed_m[i]));
  }
  assert(total > 0.0);
  const double p95 = percentile(counted, 95.0).value_or(0.0);
  return {std::move(signed_m), std::sqrt(squares / total), p95};
}

std::vector<double> weights_or_ones(std::span<const double> weights, std::size_t size) {
  return weights.empty() ? std::vector<double>(size, 1.0)
                         : std::vector<double>(weights.begin(), weights.end());
}

}  // namespace verge::fit
