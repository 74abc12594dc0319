// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/core/statistics.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <vector>

namespace verge {

std::optional<double> percentile(std::span<const double> values, double percent) {
  assert(percent >= 0.0 && percent <= 100.0);
  assert(std::ranges::all_of(values, [](double v) { return std::isfinite(v); }));
  if (values.empty()) return std::nullopt;
  std::vector<double> v(values.begin(), values.end());
  const double position = static_cast<double>(v.size() - 1) * percent / 100.0;
  const auto below = static_cast<std::ptrdiff_t>(position);
  std::nth_element(v.begin(), v.begin() + below, v.end());
  const double lower = v[static_cast<std::size_t>(below)];
  const double share = position - static_cast<double>(below);
  if (share == 0.0) return lower;
  const double upper = *std::min_element(v.begin() + below + 1, v.end());
  return lower + share * (upper - lower);
}

std::optional<double> median(std::span<const double> values) { return percentile(values, 50.0); }

std::optional<double> mean(std::span<const double> values) {
  if (values.empty()) return std::nullopt;
  double sum = 0.0;
  for (const double v : values) sum += v;
  return sum / static_cast<double>(values.size());
}

}  // namespace verge
