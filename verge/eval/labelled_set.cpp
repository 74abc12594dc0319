// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/eval/labelled_set.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "verge/eval/box_labels.hpp"
#include "verge/eval/files_below.hpp"
#include "verge/eval/kerb_tables.hpp"
#include "verge/eval/label_rings.hpp"
#include "verge/io/sniff.hpp"

namespace verge::eval {
namespace fs = std::filesystem;
namespace {

/// What the labels beside a scan's file would be called.
fs::path nuscenes_labels(const fs::path& scan) {
  return scan.parent_path().parent_path() / "lidarseg" /
         fmt::format("{}_lidarseg.bin", frame_stem(scan.filename().string()));
}
fs::path kitti_labels(const fs::path& scan) {
  return scan.parent_path().parent_path() / "labels" / (scan.stem().string() + ".label");
}
fs::path box_labels(const fs::path& scan) {
  return scan.parent_path() / fmt::format("{}_boxes.json", frame_stem(scan.filename().string()));
}
fs::path kerb_labels(const fs::path& scan) { return fs::path(scan).replace_extension(".label"); }

Expected<std::vector<LabelledScan>> scans_of_tables(const std::vector<fs::path>& tables) {
  std::vector<LabelledScan> scans;
  for (const fs::path& table : tables) {
    auto frames = read_kerb_table(table);
    if (!frames) return Unexpected(std::move(frames).error());
    for (auto& [frame, kerb] : *frames) {
      scans.push_back({frame, LabelFormat::kKerbTable, {}, table, std::move(kerb)});
    }
  }
  return scans;
}

/// Scans that have labels beside them, in the order nuScenes, SemanticKITTI, kerb labels, kerb polygons.
std::vector<LabelledScan> scans_with_labels(const std::vector<fs::path>& files) {
  std::map<LabelFormat, std::vector<LabelledScan>> scans;
  const std::set<fs::path> there(files.begin(), files.end());
  const auto add = [&](LabelFormat format, const fs::path& scan, const fs::path& labels) {
    if (!there.contains(labels)) return;
    scans[format].push_back({frame_stem(scan.filename().string()), format, scan, labels, {}});
  };
  for (const fs::path& file : files) {
    const std::string name = file.filename().string();
    if (name.ends_with(".pcd.bin")) add(LabelFormat::kNuscenes, file, nuscenes_labels(file));
    if (name.ends_with(".bin")) add(LabelFormat::kSemanticKitti, file, kitti_labels(file));
    if (name.ends_with(".pcd")) add(LabelFormat::kKerbLabels, file, kerb_labels(file));
    if (name.ends_with(".gt"))
      scans[LabelFormat::kKerbPolygons].push_back(
          {file.stem().string(), LabelFormat::kKerbPolygons, {}, file, {}});
  }
  std::vector<LabelledScan> all;
  for (auto& [format, some] : scans) std::move(some.begin(), some.end(), std::back_inserter(all));
  return all;
}

Expected<std::vector<LabelledScan>> all_scans(const fs::path& place) {
  std::error_code error;
  const fs::file_status status = fs::status(place, error);
  if (!fs::exists(status)) {
    if (!error) error = std::make_error_code(std::errc::no_such_file_or_directory);
    return Unexpected(cannot_open(place, error));
  }
  if (!fs::is_directory(status)) return scans_of_tables({place});
  const auto files = files_below(place);
  if (!files) return Unexpected(files.error());
  std::vector<fs::path> tables;
  std::copy_if(files->begin(), files->end(), std::back_inserter(tables),
               [](const fs::path& file) { return file.filename() == "truth.csv"; });
  return tables.empty() ? scans_with_labels(*files) : scans_of_tables(tables);
}

/// Scans of which there are some, each frame once.
Expected<std::vector<LabelledScan>> checked(std::vector<LabelledScan> scans, const fs::path& folder,
                                            std::string_view none, std::string_view need) {
  if (scans.empty()) {
    return Unexpected(
        Error{ErrorCode::kUnusable, folder.string(), {}, std::string(none), {}, std::string(need)});
  }
  std::set<std::string_view> frames;
  for (const LabelledScan& scan : scans) {
    if (frames.insert(scan.frame).second) continue;
    return Unexpected(Error{ErrorCode::kUsage,
                            folder.string(),
                            {},
                            "a scan stands in more than one folder: evaluate one data set at a time",
                            scan.frame,
                            {}});
  }
  return scans;
}

Expected<LabelledTruth> truth_of_boxes(const fs::path& boxes) {
  auto objects = read_nuscenes_boxes(boxes);
  if (!objects) return Unexpected(std::move(objects).error());
  LabelledTruth truth;
  truth.objects = *std::move(objects);
  return truth;
}

}  // namespace

std::string frame_stem(std::string_view name) {
  const std::string file = fs::path(name).filename().string();
  return file.substr(0, file.size() - io::scan_suffix(file).size());
}

Expected<std::vector<LabelledScan>> find_labelled_scans(const fs::path& folder) {
  auto scans = all_scans(folder);
  if (!scans) return scans;
  return checked(*std::move(scans), folder, "has no labelled scans",
                 "lidarseg/ or labels/ beside the scans, NAME.label, NAME.gt or truth.csv");
}

Expected<std::vector<LabelledScan>> find_boxed_scans(const fs::path& folder) {
  const auto files = files_below(folder);
  if (!files) return Unexpected(files.error());
  const std::set<fs::path> there(files->begin(), files->end());
  std::vector<LabelledScan> scans;
  for (const fs::path& file : *files) {
    const std::string name = file.filename().string();
    if (!name.ends_with(".pcd.bin") || !there.contains(box_labels(file))) continue;
    scans.push_back({frame_stem(name), LabelFormat::kBoxes, file, box_labels(file), {}});
  }
  return checked(std::move(scans), folder, "has no scans with boxes", "NAME.pcd.bin and NAME_boxes.json");
}

Expected<LabelledTruth> read_labelled_truth(const LabelledScan& scan, double gap_m) {
  Expected<LabelledTruth> truth;
  switch (scan.format) {
    case LabelFormat::kKerbTable:
      truth = truth_of_kerb_points(scan.kerb);
      break;
    case LabelFormat::kNuscenes:
      truth = read_nuscenes_truth(scan.scan, scan.labels, gap_m);
      break;
    case LabelFormat::kSemanticKitti:
      truth = read_kitti_truth(scan.scan, scan.labels, gap_m);
      break;
    case LabelFormat::kKerbLabels:
      truth = read_kerb_label_truth(scan.scan, scan.labels);
      break;
    case LabelFormat::kKerbPolygons:
      truth = read_kerb_polygons(scan.labels);
      break;
    case LabelFormat::kBoxes:
      truth = truth_of_boxes(scan.labels);
      break;
  }
  if (truth) truth->frame = scan.frame;
  return truth;
}

}  // namespace verge::eval
