// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "verge/eval/scene_match.hpp"

namespace verge::eval {

/// One predicted sample near its truth.
struct LateralError {
  double range_m = 0.0;
  double outward_m = 0.0;             ///< Positive: the road is predicted too wide.
  std::optional<double> heading_rad;  ///< None for single points.
};

/// The predicted samples within range_m of the sensor and `matched_m` of the truth. Those of several scans
/// are put behind each other.
[[nodiscard]] std::vector<LateralError> lateral_errors(const SceneMatch& match, double range_m,
                                                       double matched_m = 1.0);

/// None where there is no error to tell.
struct LateralSummary {
  std::size_t samples = 0;
  std::optional<double> median_m;  ///< With its sign.
  std::optional<double> rmse_m;
  std::optional<double> percentile_95_m;   ///< Of the size.
  std::optional<double> mean_heading_rad;  ///< Of the size.
  std::optional<double> percentile_95_heading_rad;
};
[[nodiscard]] LateralSummary summarise(std::span<const LateralError> errors);

/// Summaries of the rings around the sensor, each width_m wide, from 0 to the last one with errors.
[[nodiscard]] std::vector<LateralSummary> summarise_by_range(std::span<const LateralError> errors,
                                                             double width_m);

/// How far two sets of boundaries are apart, over samples within the range that have a counterpart of their
/// side; none where either has no such sample.
struct LineDistances {
  std::optional<double> hausdorff_95_m;  ///< The greater of the two directed 95th percentiles.
  std::optional<double> chamfer_m;       ///< Mean of the two directed means.
};
[[nodiscard]] LineDistances line_distances(const SceneMatch& match, double range_m);

}  // namespace verge::eval
