// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/eval/ground_labels.hpp"

#include <algorithm>
#include <iterator>
#include <utility>
#include <vector>

#include "verge/eval/files_below.hpp"
#include "verge/eval/label_files.hpp"

namespace verge::eval {
namespace fs = std::filesystem;
namespace {

Error about(const fs::path& path, ErrorCode code, std::string what, std::string got, std::string need) {
  return {code, path.string(), {}, std::move(what), std::move(got), std::move(need)};
}

LabelScheme scheme_of(LabelFormat format) {
  return format == LabelFormat::kNuscenes ? LabelScheme::kNuscenes : LabelScheme::kSemanticKitti;
}

bool is_label_file(const fs::path& file) {
  const std::string name = file.filename().string();
  return name.ends_with(".label") || name.ends_with("_lidarseg.bin");
}

}  // namespace

Expected<GroundTruth> read_ground_truth(const LabelledScan& scan) {
  if (scan.format != LabelFormat::kNuscenes && scan.format != LabelFormat::kSemanticKitti) {
    return Unexpected(about(scan.labels, ErrorCode::kUnusable, "labels do not say what is ground", {},
                            "labels of nuScenes lidarseg or SemanticKITTI"));
  }
  auto both = read_labelled_cloud(scan.format, scan.scan, scan.labels);
  if (!both) return Unexpected(std::move(both).error());
  GroundTruth truth{scan.frame, std::move(both->cloud), {}};
  truth.classes.reserve(both->labels.size());
  std::transform(both->labels.begin(), both->labels.end(), std::back_inserter(truth.classes),
                 [&](std::uint32_t label) { return ground_class_of(scheme_of(scan.format), label); });
  return truth;
}

Expected<std::map<std::string, fs::path>> find_label_files(const fs::path& folder) {
  const auto files = files_below(folder);
  if (!files) return Unexpected(files.error());
  std::map<std::string, fs::path> by_name;
  for (const fs::path& file : *files) {
    if (!is_label_file(file)) continue;
    const std::string name = file.filename().string();
    if (!by_name.emplace(name, file).second) {
      return Unexpected(about(
          folder, ErrorCode::kUsage,
          "labels of one name stand in more than one folder: evaluate one data set at a time", name, {}));
    }
  }
  if (by_name.empty()) {
    return Unexpected(
        about(folder, ErrorCode::kUnusable, "has no labels", {}, "NAME.label or NAME_lidarseg.bin"));
  }
  return by_name;
}

Expected<GroundPrediction> read_ground_prediction(const fs::path& labels, const LabelledScan& scan,
                                                  const GroundTruth& truth) {
  const auto numbers = read_labels(scan.format, labels, truth.cloud.x.size());
  if (!numbers) return Unexpected(numbers.error());
  GroundPrediction prediction;
  prediction.is_ground.reserve(numbers->size());
  for (const std::uint32_t label : *numbers)
    prediction.is_ground.push_back(ground_class_of(scheme_of(scan.format), label) == GroundClass::kGround);
  return prediction;
}

}  // namespace verge::eval
