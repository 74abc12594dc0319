// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "apps/verge/evaluate_truth.hpp"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "apps/verge/evaluation_report.hpp"
#include "apps/verge/scene_file.hpp"

namespace verge::app {
namespace {

/// `preferred` where the list has it, else its first.
double headline_of(const std::vector<double>& list, double preferred) {
  return std::find(list.begin(), list.end(), preferred) != list.end() ? preferred : list.front();
}

eval::SceneEvaluationConfig config_of(const EvaluateRequest& request) {
  eval::SceneEvaluationConfig config;
  if (request.range_m) config.range_m = *request.range_m;
  config.any_side = request.any_side;
  if (!request.tolerance_m.empty()) config.tolerances_m = request.tolerance_m;
  config.tolerance_m = headline_of(config.tolerances_m, config.tolerance_m);
  std::vector<double>& ranges = config.ranges_m;
  if (std::find(ranges.begin(), ranges.end(), config.range_m) == ranges.end())
    ranges.push_back(config.range_m);
  std::sort(ranges.begin(), ranges.end());
  return config;
}

TruthEvaluation compare(const SceneFile& predictions, const SceneFile& truth,
                        const eval::SceneEvaluationConfig& config) {
  TruthEvaluation evaluation;
  evaluation.config = config;
  std::vector<eval::CornerFrame> drive;
  for (const Scene& scene : truth.scenes) {
    const Scene* prediction = predictions.find(scene.frame);
    eval::SceneEvaluation scan = eval::evaluate_scene(prediction, scene, config);
    evaluation.all += scan;
    evaluation.scan_cells.push_back(std::move(scan.cells));
    drive.push_back({prediction, &scene});
  }
  evaluation.corners = eval::score_corners(drive);
  return evaluation;
}

Error empty_truth(const std::string& file) {
  return {ErrorCode::kUnusable, file, {}, "has no scene to compare with", {}, {}};
}

std::vector<std::string> frames_of(const SceneFile& file) {
  std::vector<std::string> frames;
  for (const Scene& scene : file.scenes) frames.push_back(scene.frame);
  return frames;
}

}  // namespace

Expected<EvaluationOutput> evaluate_truth(const EvaluateRequest& request, Console& console) {
  const auto predictions = read_scenes(request.predictions);
  if (!predictions) return Unexpected(predictions.error());
  const auto truth = read_scenes(*request.truth);
  if (!truth) return Unexpected(truth.error());
  if (truth->scenes.empty()) return Unexpected(empty_truth(*request.truth));
  TruthEvaluation evaluation = compare(*predictions, *truth, config_of(request));
  if (evaluation.all.absent == evaluation.all.scans)
    return Unexpected(no_frame_matches(request.predictions, *predictions, frames_of(*truth)));
  const eval::BoundaryErrorConfig errors{.range_m = evaluation.config.range_m,
                                         .tolerance_m = evaluation.config.tolerance_m,
                                         .any_side = request.any_side};
  auto comparison = eval::compare_all(predictions->scenes, truth->scenes, errors);
  if (!comparison) return Unexpected(std::move(comparison).error());
  evaluation.errors = *std::move(comparison);
  if (const auto& strays = evaluation.errors.frames_without_truth; !strays.empty()) {
    console.warning(fmt::format("{} predicted frames have no truth and are left out, the first is {}",
                                strays.size(), strays.front()));
  }
  return EvaluationOutput{truth_table(evaluation, request.per_frame), truth_json(evaluation),
                          truth_csv(evaluation)};
}

}  // namespace verge::app
