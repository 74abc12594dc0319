// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "apps/verge/evaluate_labels.hpp"

#include <chrono>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "apps/verge/label_report.hpp"
#include "apps/verge/progress.hpp"
#include "apps/verge/scene_file.hpp"
#include "verge/eval/label_score.hpp"
#include "verge/eval/labelled_set.hpp"

namespace verge::app {
namespace {

eval::LabelScoreConfig config_of(const EvaluateRequest& request) {
  eval::LabelScoreConfig config;
  if (request.range_m) config.range_m = *request.range_m;
  if (!request.tolerance_m.empty()) config.tolerance_m = request.tolerance_m;
  return config;
}

/// Scores scan by scan: no more than one scan's points are in memory.
Expected<LabelEvaluation> score_all(const std::vector<eval::LabelledScan>& scans,
                                    const SceneFile& predictions, const EvaluateRequest& request,
                                    Console& console) {
  LabelEvaluation evaluation;
  evaluation.config = config_of(request);
  evaluation.gap_m = request.gap_m;
  const auto begin = std::chrono::steady_clock::now();
  for (const eval::LabelledScan& scan : scans) {
    const auto truth = eval::read_labelled_truth(scan, request.gap_m);
    if (!truth) return Unexpected(truth.error());
    eval::LabelScore score = eval::score(*truth, predictions.find(scan.frame), evaluation.config);
    evaluation.all += score;
    evaluation.scans.push_back({scan.frame, std::move(score)});
    const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - begin;
    console.progress(progress_line(evaluation.scans.size(), scans.size(), taken.count()));
  }
  return evaluation;
}

}  // namespace

Expected<EvaluationOutput> evaluate_labels(const EvaluateRequest& request, Console& console) {
  const auto predictions = read_scenes(request.predictions);
  if (!predictions) return Unexpected(predictions.error());
  const auto scans = eval::find_labelled_scans(*request.labels);
  if (!scans) return Unexpected(scans.error());
  const auto evaluation = score_all(*scans, *predictions, request, console);
  if (!evaluation) return Unexpected(evaluation.error());
  if (evaluation->all.absent == evaluation->all.scans) {
    std::vector<std::string> frames;
    for (const eval::LabelledScan& scan : *scans) frames.push_back(scan.frame);
    return Unexpected(no_frame_matches(request.predictions, *predictions, frames));
  }
  if (const std::size_t matched = evaluation->all.scans - evaluation->all.absent;
      matched < predictions->scenes.size()) {
    console.warning(fmt::format("{} of {} predicted frames have no labels and are left out",
                                predictions->scenes.size() - matched, predictions->scenes.size()));
  }
  return EvaluationOutput{label_table(*evaluation, request.per_frame), label_json(*evaluation),
                          label_csv(*evaluation)};
}

}  // namespace verge::app
