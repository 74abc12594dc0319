// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "verge/eval/boundary_error.hpp"
#include "verge/eval/corner_score.hpp"
#include "verge/eval/scene_evaluation.hpp"

namespace verge::app {

/// Predictions against Scenes that are true.
struct TruthEvaluation {
  eval::SceneEvaluationConfig config;
  eval::Comparison errors;  ///< Distances, scan by scan.
  eval::SceneEvaluation all;
  std::vector<std::vector<eval::ToleranceCell>> scan_cells;  ///< Of each scan, in the order of errors.scans.
  eval::CornerScore corners;
};

/// Distances by road shape, then what the metrics of docs/evaluation.md came to; those of parts that neither
/// side has are left out. With `per_frame` also a row a scan.
[[nodiscard]] std::string truth_table(const TruthEvaluation& evaluation, bool per_frame);

/// The same as one JSON object with the counts behind the figures and the distances of each scan; a figure
/// that does not exist or is not finite is null.
[[nodiscard]] std::string truth_json(const TruthEvaluation& evaluation);

/// Counts and figures at every range and tolerance, of all scans and of each; RFC 4180.
[[nodiscard]] std::string truth_csv(const TruthEvaluation& evaluation);

}  // namespace verge::app
