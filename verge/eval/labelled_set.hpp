// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "verge/core/error.hpp"
#include "verge/core/vec.hpp"
#include "verge/eval/labelled_truth.hpp"

namespace verge::eval {

/// How the truth of a scan lies beside it.
enum class LabelFormat : std::uint8_t {
  kKerbTable,      ///< truth.csv: frame,side,x,y,z; hand-picked kerb points.
  kNuscenes,       ///< A/NAME.pcd.bin and lidarseg/NAME_lidarseg.bin beside A: uint8 a point.
  kSemanticKitti,  ///< A/NAME.bin and labels/NAME.label beside A: uint32 a point.
  kKerbLabels,     ///< NAME.pcd and NAME.label: uint8 a point, 0 road, 1 kerb, 2 off, 255 not annotated.
  kKerbPolygons,   ///< NAME.gt: polygons in millimetres; an edge that two of them share is a kerb.
  kBoxes           ///< NAME.pcd.bin and NAME_boxes.json beside it: boxes round objects.
};

/// One scan whose truth can be read.
struct LabelledScan {
  std::string frame;
  LabelFormat format = LabelFormat::kKerbTable;
  std::filesystem::path scan;    ///< Empty where the truth needs no points.
  std::filesystem::path labels;  ///< The table, the labels or the polygons.
  std::vector<Vec2> kerb{};      ///< Of a table: its points.
};

/// The name of a frame without folder and without the suffix of a scan's file: "a/000123.pcd.bin" is 000123.
/// Any other suffix belongs to the name.
[[nodiscard]] std::string frame_stem(std::string_view name);

/// All labelled scans in and below a folder, or of one table. Where a truth.csv stands somewhere below, the
/// tables are the truth and nothing else is looked at. Fails with kCannotOpen, kUnusable (no labelled scans,
/// a table with a row that is none, at its place), and kUsage where a frame stands in two places.
[[nodiscard]] Expected<std::vector<LabelledScan>> find_labelled_scans(const std::filesystem::path& folder);

/// All nuScenes scans in and below a folder that have boxes beside them; they are no labelled scans, since
/// boxes say nothing of boundaries. Fails with kCannotOpen, kUnusable where there are none, and kUsage where
/// a frame stands in two places.
[[nodiscard]] Expected<std::vector<LabelledScan>> find_boxed_scans(const std::filesystem::path& folder);

/// The truth of a scan. `gap_m` is the widest gap between two returns of a ring with a boundary in between,
/// for labels of whole scans. Points that are not finite, and returns within 0.5 m of nuScenes' sensor, do
/// not count. Fails as the readers of scans do, and with kUnusable where labels and points are not equally
/// many, or where a file of boxes is not one.
[[nodiscard]] Expected<LabelledTruth> read_labelled_truth(const LabelledScan& scan, double gap_m);

}  // namespace verge::eval
