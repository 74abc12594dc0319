// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/pipeline/summary.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace verge::pipeline {

void add(Counts& counts, const Scan& scan, const Scene& scene) {
  const auto empty = static_cast<std::uint64_t>(std::count(scan.range.begin(), scan.range.end(), 0.0F));
  ++counts.scans;
  counts.boundaries += scene.boundaries.size();
  counts.points.received += scan.size() + scan.dropped;
  counts.points.not_finite += scan.dropped;
  counts.points.no_return += empty;
  counts.points.used += scan.size() - empty;
}

std::optional<double> percentile(std::vector<double> values, double p) {
  assert(p > 0.0 && p <= 1.0);
  if (values.empty()) return std::nullopt;
  const auto rank = static_cast<std::size_t>(std::ceil(p * static_cast<double>(values.size())));
  const std::size_t index = std::clamp<std::size_t>(rank, 1, values.size()) - 1;
  const auto nth = values.begin() + static_cast<std::ptrdiff_t>(index);
  std::nth_element(values.begin(), nth, values.end());
  return *nth;
}

}  // namespace verge::pipeline
