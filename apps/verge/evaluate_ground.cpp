// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "apps/verge/evaluate_ground.hpp"

#include <chrono>
#include <cstddef>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "apps/verge/ground_report.hpp"
#include "apps/verge/progress.hpp"
#include "verge/eval/ground_labels.hpp"
#include "verge/eval/ground_plane.hpp"
#include "verge/eval/labelled_set.hpp"

namespace verge::app {
namespace {

using LabelFiles = std::map<std::string, std::filesystem::path>;
using Prediction = std::optional<eval::GroundPrediction>;

std::string label_file_of(const eval::LabelledScan& scan) { return scan.labels.filename().string(); }

/// The prediction of a scan by its label file; none where there is none.
Expected<Prediction> by_labels(const LabelFiles& files, const eval::LabelledScan& scan,
                               const eval::GroundTruth& truth) {
  const auto file = files.find(label_file_of(scan));
  if (file == files.end()) return Prediction();
  auto prediction = eval::read_ground_prediction(file->second, scan, truth);
  if (!prediction) return Unexpected(std::move(prediction).error());
  return Prediction(*std::move(prediction));
}

/// Scores scan by scan: no more than one scan's points are in memory. No files: by the plane.
Expected<GroundEvaluation> score_all(const std::vector<eval::LabelledScan>& scans,
                                     const std::optional<LabelFiles>& files, const EvaluateRequest& request,
                                     Console& console) {
  GroundEvaluation evaluation;
  if (request.range_m) evaluation.config.range_m = *request.range_m;
  if (!files) evaluation.plane = request.plane;
  const auto begin = std::chrono::steady_clock::now();
  for (const eval::LabelledScan& scan : scans) {
    const auto truth = eval::read_ground_truth(scan);
    if (!truth) return Unexpected(truth.error());
    auto prediction = files ? by_labels(*files, scan, *truth)
                            : Expected<Prediction>(eval::ground_by_plane(truth->cloud, request.plane));
    if (!prediction) return Unexpected(std::move(prediction).error());
    const eval::GroundScore score =
        eval::score_ground(*truth, *prediction ? &**prediction : nullptr, evaluation.config);
    evaluation.all += score;
    evaluation.scans.push_back({scan.frame, score});
    const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - begin;
    console.progress(progress_line(evaluation.scans.size(), scans.size(), taken.count()));
  }
  return evaluation;
}

/// How many of the files belong to none of the scans.
std::size_t strays_among(const LabelFiles& files, const std::vector<eval::LabelledScan>& scans) {
  std::size_t strays = files.size();
  for (const eval::LabelledScan& scan : scans) strays -= files.count(label_file_of(scan));
  return strays;
}

/// The label files of the request; none where it names no folder.
Expected<std::optional<LabelFiles>> files_of(const EvaluateRequest& request,
                                             const std::vector<eval::LabelledScan>& scans, Console& console) {
  if (request.predictions.empty()) return std::optional<LabelFiles>();
  auto files = eval::find_label_files(request.predictions);
  if (!files) return Unexpected(std::move(files).error());
  const std::size_t strays = strays_among(*files, scans);
  if (strays == files->size()) {
    return Unexpected(Error{ErrorCode::kUnusable,
                            request.predictions,
                            {},
                            "no labels of these scans",
                            files->begin()->first,
                            label_file_of(scans.front())});
  }
  if (strays > 0) {
    console.warning(fmt::format("{} of {} predicted label files belong to no scan and are left out", strays,
                                files->size()));
  }
  return std::optional<LabelFiles>(*std::move(files));
}

}  // namespace

Expected<EvaluationOutput> evaluate_ground(const EvaluateRequest& request, Console& console) {
  const auto scans = eval::find_labelled_scans(*request.labels);
  if (!scans) return Unexpected(scans.error());
  const auto files = files_of(request, *scans, console);
  if (!files) return Unexpected(files.error());
  const auto evaluation = score_all(*scans, *files, request, console);
  if (!evaluation) return Unexpected(evaluation.error());
  return EvaluationOutput{ground_table(*evaluation, request.per_frame), ground_json(*evaluation),
                          ground_csv(*evaluation)};
}

}  // namespace verge::app
