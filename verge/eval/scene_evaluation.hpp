// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "verge/eval/boundary_error.hpp"
#include "verge/eval/frame_success.hpp"
#include "verge/eval/junction_score.hpp"
#include "verge/eval/lateral.hpp"
#include "verge/eval/object_score.hpp"
#include "verge/eval/stations.hpp"
#include "verge/eval/tolerance_score.hpp"

namespace verge::eval {

/// What Scenes are compared with their truth by: docs/evaluation.md has the definitions.
struct SceneEvaluationConfig {
  double range_m = 20.0;     ///< Of the headline, of stations, lateral errors, success and objects.
  double tolerance_m = 0.2;  ///< Of the headline, of the bins by range and of the precision-recall curve.
  std::vector<double> ranges_m{10.0, 20.0, 40.0, 200.0};
  std::vector<double> tolerances_m{0.05, 0.1, 0.2, 0.3, 0.5};
  bool any_side = false;
};

/// All that one scan, or many together, came to. Everything in it adds up.
struct SceneEvaluation {
  std::size_t scans = 0;
  std::size_t absent = 0;  ///< Scans without a prediction.
  std::vector<ToleranceCell> cells;
  RangeBins by_range;
  std::vector<ConfidencePoint> by_confidence;
  std::vector<StationCounts> stations;
  std::vector<LateralError> lateral;
  std::vector<double> hausdorff_95_m;  ///< Of each scan that has one.
  std::vector<double> chamfer_m;
  SuccessCounts straight;  ///< Scans by what the road does within the range.
  SuccessCounts curve;
  JunctionScore junctions;
  ObjectScore objects;

  SceneEvaluation& operator+=(const SceneEvaluation& more);
};

/// One scan; a null prediction counts as absent, and as nothing found.
[[nodiscard]] SceneEvaluation evaluate_scene(const Scene* prediction, const Scene& truth,
                                             const SceneEvaluationConfig& config);

}  // namespace verge::eval
