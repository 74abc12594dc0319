// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "verge/core/vec.hpp"
#include "verge/eval/labelled_truth.hpp"
#include "verge/model/scene.hpp"

namespace verge::eval {

/// How predictions are scored against labels.
struct LabelScoreConfig {
  double range_m = 20.0;  ///< Points and samples nearer than this count.
  std::vector<double> tolerance_m{0.1, 0.2, 0.3, 0.5};
};

/// What scans came to at one tolerance. Counts of several scans are added up.
struct ToleranceScore {
  double tolerance_m = 0.0;
  std::size_t found = 0;        ///< True points with a prediction nearer than the tolerance.
  std::size_t found_kerbs = 0;  ///< Of those with a step of 5 cm or more.
  std::size_t judged = 0;       ///< Predicted samples that were right or wrong.
  std::size_t right = 0;        ///< Of those, nearer to the true boundary than the tolerance.
  double squared_m2 = 0.0;      ///< Of the found points' distances.
  double f1_sum = 0.0;          ///< Of the scans' own F1.
};

/// What scans came to.
struct LabelScore {
  std::size_t scans = 0;
  std::size_t absent = 0;       ///< Scans without a prediction.
  std::size_t true_points = 0;  ///< Within the range.
  std::size_t kerb_points = 0;  ///< Of those with a step of 5 cm or more, where labels cover whole scans.
  std::size_t samples = 0;      ///< Of predicted lines, every 0.1 m, within the range.
  std::vector<ToleranceScore> at;

  /// Both scores must be at the same tolerances, or one of them be of no scan.
  LabelScore& operator+=(const LabelScore& more);
};

/// Scores one scan; no prediction counts as absent, and as nothing found. Distances are in the plane, and
/// sides do not matter. Samples that cannot be judged are: those with no labelled ground within 1 m; those
/// within 0.3 m of a hidden stretch, unless they are right; where labels cover only a part of the scan, those
/// 2 m or more from every true point.
[[nodiscard]] LabelScore score(const LabelledTruth& truth, const Scene* prediction,
                               const LabelScoreConfig& config);

/// The figures of scans at one tolerance. A share of nothing is 0.
struct LabelFigures {
  double precision = 0.0;
  double recall = 0.0;
  double f1 = 0.0;  ///< Harmonic mean of the two, over all scans together (micro).
  double macro_f1 = 0.0;
  std::optional<double> kerb_recall;
  double rmse_m = 0.0;
  double judged = 0.0;  ///< Share of the samples that could be judged.
};
[[nodiscard]] LabelFigures figures_of(const LabelScore& score, const ToleranceScore& at);

/// Points every `step` of the line's length from its first point on, the last one up to half a step past its
/// end (then the end itself); those nearer to the origin than `reach`. A line of one point is that point. A
/// line is not followed beyond 1e9 m of its length.
[[nodiscard]] std::vector<Vec2> samples_within(std::span<const Vec2> line, double step, double reach);

}  // namespace verge::eval
