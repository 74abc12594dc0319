// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/eval/scene_evaluation.hpp"

#include <algorithm>

namespace verge::eval {
namespace {

template <class Value>
void append(std::vector<Value>& to, const std::vector<Value>& from) {
  to.insert(to.end(), from.begin(), from.end());
}

void judge_whole_scan(const SceneMatch& match, const Scene& truth, double range_m,
                      SceneEvaluation& evaluation) {
  const LineDistances apart = line_distances(match, range_m);
  if (apart.hausdorff_95_m) evaluation.hausdorff_95_m.push_back(*apart.hausdorff_95_m);
  if (apart.chamfer_m) evaluation.chamfer_m.push_back(*apart.chamfer_m);
  const auto deviation = deviation_of(match, range_m);
  if (!deviation) return;
  const bool is_straight = shape_of(truth, range_m) == RoadShape::kStraight;
  (is_straight ? evaluation.straight : evaluation.curve).count(*deviation);
}

}  // namespace

SceneEvaluation& SceneEvaluation::operator+=(const SceneEvaluation& more) {
  scans += more.scans;
  absent += more.absent;
  add_cells(cells, more.cells);
  by_range += more.by_range;
  add_points(by_confidence, more.by_confidence);
  add_stations(stations, more.stations);
  append(lateral, more.lateral);
  append(hausdorff_95_m, more.hausdorff_95_m);
  append(chamfer_m, more.chamfer_m);
  straight += more.straight;
  curve += more.curve;
  junctions += more.junctions;
  objects += more.objects;
  return *this;
}

SceneEvaluation evaluate_scene(const Scene* prediction, const Scene& truth,
                               const SceneEvaluationConfig& config) {
  const Scene nothing;
  const Scene& predicted = prediction == nullptr ? nothing : *prediction;
  MatchConfig matching;
  matching.range_m =
      std::max(config.range_m, *std::max_element(config.ranges_m.begin(), config.ranges_m.end()));
  matching.any_side = config.any_side;
  const SceneMatch match = match_boundaries(predicted, truth, matching);
  SceneEvaluation evaluation;
  evaluation.scans = 1;
  evaluation.absent = prediction == nullptr ? 1 : 0;
  evaluation.cells = tolerance_cells(match, config.ranges_m, config.tolerances_m);
  evaluation.by_range = count_by_range(match, evaluation.by_range.width_m, config.tolerance_m);
  evaluation.by_confidence =
      count_by_confidence(predicted, truth, matching, config.range_m, config.tolerance_m);
  evaluation.stations = count_stations(predicted, truth, {.range_m = config.range_m});
  evaluation.lateral = lateral_errors(match, config.range_m);
  judge_whole_scan(match, truth, config.range_m, evaluation);
  evaluation.junctions = score_junction(predicted, truth);
  evaluation.objects = score_objects(predicted, truth, config.range_m);
  return evaluation;
}

}  // namespace verge::eval
