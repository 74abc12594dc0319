// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/core/statistics.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <vector>

namespace verge {

double value_at_rank(std::vector<double>& values, double position) {
  assert(position >= 0.0 && position <= static_cast<double>(values.size() - 1));
  assert(std::ranges::all_of(values, [](double v) { return std::isfinite(v); }));
  const auto below = values.begin() + static_cast<std::ptrdiff_t>(position);
  std::nth_element(values.begin(), below, values.end());
  const double share = position - std::floor(position);
  if (share == 0.0) return *below;
  const double upper = *std::min_element(below + 1, values.end());
  return *below + share * (upper - *below);
}

std::optional<double> percentile(std::span<const double> values, double percent) {
  assert(percent >= 0.0 && percent <= 100.0);
  if (values.empty()) return std::nullopt;
  std::vector<double> copy(values.begin(), values.end());
  return value_at_rank(copy, static_cast<double>(copy.size() - 1) * percent / 100.0);
}

std::optional<double> median(std::span<const double> values) { return percentile(values, 50.0); }

std::optional<double> mean(std::span<const double> values) {
  if (values.empty()) return std::nullopt;
  double sum = 0.0;
  for (const double v : values) sum += v;
  return sum / static_cast<double>(values.size());
}

}  // namespace verge
