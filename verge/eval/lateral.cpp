// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/eval/lateral.hpp"

#include <algorithm>
#include <cmath>

#include "verge/core/statistics.hpp"

namespace verge::eval {
namespace {

std::vector<double> distances_within(std::span<const MatchedSample> samples, double range_m) {
  std::vector<double> distances;
  for (const MatchedSample& sample : samples) {
    if (sample.range_m < range_m && std::isfinite(sample.distance_m)) distances.push_back(sample.distance_m);
  }
  return distances;
}

std::optional<double> root_mean_square(std::span<const double> values) {
  std::vector<double> squares;
  for (const double value : values) squares.push_back(value * value);
  const auto mean_square = mean(squares);
  return mean_square ? std::optional(std::sqrt(*mean_square)) : std::nullopt;
}

}  // namespace

std::vector<LateralError> lateral_errors(const SceneMatch& match, double range_m, double matched_m) {
  std::vector<LateralError> errors;
  for (const MatchedSample& sample : match.predicted) {
    if (sample.range_m < range_m && sample.distance_m < matched_m)
      errors.push_back({sample.range_m, sample.outward_m, sample.heading_rad});
  }
  return errors;
}

LateralSummary summarise(std::span<const LateralError> errors) {
  std::vector<double> outward;
  std::vector<double> sizes;
  std::vector<double> headings;
  for (const LateralError& error : errors) {
    outward.push_back(error.outward_m);
    sizes.push_back(std::fabs(error.outward_m));
    if (error.heading_rad) headings.push_back(std::fabs(*error.heading_rad));
  }
  return {.samples = errors.size(),
          .median_m = median(outward),
          .rmse_m = root_mean_square(outward),
          .percentile_95_m = percentile(sizes, 95.0),
          .mean_heading_rad = mean(headings),
          .percentile_95_heading_rad = percentile(headings, 95.0)};
}

std::vector<LateralSummary> summarise_by_range(std::span<const LateralError> errors, double width_m) {
  std::vector<std::vector<LateralError>> bins;
  for (const LateralError& error : errors) {
    const auto index = static_cast<std::size_t>(error.range_m / width_m);
    if (index >= bins.size()) bins.resize(index + 1);
    bins[index].push_back(error);
  }
  std::vector<LateralSummary> summaries;
  for (const auto& bin : bins) summaries.push_back(summarise(bin));
  return summaries;
}

LineDistances line_distances(const SceneMatch& match, double range_m) {
  const std::vector<double> forth = distances_within(match.predicted, range_m);
  const std::vector<double> back = distances_within(match.truth, range_m);
  if (forth.empty() || back.empty()) return {};
  return {.hausdorff_95_m = std::max(*percentile(forth, 95.0), *percentile(back, 95.0)),
          .chamfer_m = 0.5 * (*mean(forth) + *mean(back))};
}

}  // namespace verge::eval
