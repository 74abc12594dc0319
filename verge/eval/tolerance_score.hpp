// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "verge/eval/scene_match.hpp"

namespace verge::eval {

/// Samples of boundaries within a tolerance of the other Scene's, counted; counts of several scans are added
/// up.
struct ToleranceCounts {
  std::size_t predicted = 0;
  std::size_t right = 0;  ///< Predicted samples within the tolerance of the truth, hidden or not.
  std::size_t visible = 0;
  std::size_t found_visible = 0;  ///< Visible samples of the truth within the tolerance of a prediction.
  std::size_t occluded = 0;
  std::size_t found_occluded = 0;

  ToleranceCounts& operator+=(const ToleranceCounts& more);
  friend bool operator==(const ToleranceCounts&, const ToleranceCounts&) = default;

  [[nodiscard]] std::optional<double> precision() const;  ///< None where nothing is predicted.
  [[nodiscard]] std::optional<double> recall() const;     ///< Of what is visible; none where nothing is.
  [[nodiscard]] std::optional<double> occluded_recall() const;
  /// Harmonic mean of precision and recall, one that is none counting as 0; none where both are.
  [[nodiscard]] std::optional<double> f1() const;
};

/// The samples nearer to the sensor than range_m.
[[nodiscard]] ToleranceCounts count_within(const SceneMatch& match, double range_m, double tolerance_m);

/// Counts at one range and tolerance, pooled (micro), and the scans' own F1 (macro).
struct ToleranceCell {
  double range_m = 0.0;
  double tolerance_m = 0.0;
  ToleranceCounts counts;
  double f1_sum = 0.0;
  std::size_t scans_with_f1 = 0;

  [[nodiscard]] std::optional<double> macro_f1() const;
};

/// One scan at every range and tolerance, ranges outermost.
[[nodiscard]] std::vector<ToleranceCell> tolerance_cells(const SceneMatch& match,
                                                         std::span<const double> range_m,
                                                         std::span<const double> tolerance_m);
/// Adds scans; `sum` is empty or of the same ranges and tolerances.
void add_cells(std::vector<ToleranceCell>& sum, std::span<const ToleranceCell> more);

/// Counts of rings around the sensor, each `width_m` wide, from 0 on: error and recall by range.
struct RangeBins {
  double width_m = 5.0;
  std::vector<ToleranceCounts> bins;

  RangeBins& operator+=(const RangeBins& more);
};
[[nodiscard]] RangeBins count_by_range(const SceneMatch& match, double width_m, double tolerance_m);

/// How far a method sees: the outer edge of the last bin with truth before which no bin has a recall or a
/// precision below `least`; bins with neither truth nor prediction are passed over. None where there is no
/// truth; 0 where the first bin fails.
[[nodiscard]] std::optional<double> detection_range_m(const RangeBins& bins, double least = 0.9);

/// One point of a precision-recall curve: the boundaries of at least this confidence.
struct ConfidencePoint {
  double least_confidence = 0.0;
  ToleranceCounts counts;
};
/// At each confidence from 0 to 1 in steps of 0.05.
[[nodiscard]] std::vector<ConfidencePoint> count_by_confidence(const Scene& prediction, const Scene& truth,
                                                               const MatchConfig& config, double range_m,
                                                               double tolerance_m);
void add_points(std::vector<ConfidencePoint>& sum, std::span<const ConfidencePoint> more);

}  // namespace verge::eval
