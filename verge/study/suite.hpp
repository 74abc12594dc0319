// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "verge/eval/scene_evaluation.hpp"
#include "verge/sim/drive.hpp"

namespace verge::study {

/// Made-up drives, each by its number.
struct MadeDrives {
  std::function<sim::DriveConfig(std::uint64_t drive)> make;  ///< Of 1, 2, ...: always the same of the same.
  std::size_t drives = 1;
  std::size_t scans = 1;         ///< Of each drive.
  std::uint64_t first_scan = 0;  ///< Index of the first one, ...
  std::uint64_t step = 1;        ///< ... and from one to the next.
  double lost = 0.0;             ///< Share of each scan's returns that go missing, whatever their range.
  bool seen_edges = false;       ///< Of the truth, what the scan's own returns show counts as visible.
  std::optional<Mount> mount{};  ///< What methods are told of how the sensor stands; none: they see for
                                 ///< themselves.
};

/// A folder of labelled scans.
struct LabelledScans {
  std::filesystem::path folder;
  bool odd_only = false;  ///< Judged are the scans at odd places, counted from 0; all are looked at.
  bool boxes = false;     ///< Judged are objects against boxes (box_score.hpp), not boundaries.
  std::size_t first = 0;  ///< Judged are the scans from this place ...
  std::size_t last = std::numeric_limits<std::size_t>::max();  ///< ... to this one.
};

/// A row of a suite's table: scans of one kind.
struct Cell {
  std::string name;
  std::variant<MadeDrives, LabelledScans> scans;
  std::string condition{};  ///< Of a degradation curve, as "range noise, m"; else empty.
  double value = 0.0;       ///< Of the condition.
};

/// What is judged of each scan.
struct Judged {
  bool boundaries = true;
  bool corners = false;  ///< Needs every scan of a drive: step 1.
  bool objects = false;
};

/// A column of a suite's table: a figure of figures.hpp.
struct Column {
  std::string figure;
  std::string heading;
  int digits = 3;
};

/// What somebody else printed of the same situation, shown beside ours.
struct Printed {
  std::string cell;
  std::string by;
  std::vector<std::pair<std::string, double>> figures;
};

/// A scan that the report shows as paper 3 shows its frames.
struct RoadFigure {
  std::string title;
  std::string cell;         ///< By its name.
  std::uint64_t drive = 0;  ///< Number of the drive; 0 of a labelled set.
  std::uint64_t scan = 0;   ///< Its index on the drive, or its place in the set.
  bool bend = false;        ///< Fig. 3, 4 and 7, of a corner or a junction; else Fig. 2 and 6.
};

/// An evaluation as data: on what, judged how, shown how.
struct Suite {
  std::string name;
  std::string title;
  std::string about;  ///< What the figures mean, in a sentence or two.
  std::vector<Cell> cells;
  Judged judged;
  eval::SceneEvaluationConfig evaluation;
  double label_tolerance_m = 0.3;  ///< Of labelled sets: that of the headline.
  std::vector<Column> columns;
  std::vector<Printed> printed;
  std::vector<RoadFigure> road_figures{};
};

/// What a suite is asked to be.
struct SuiteRequest {
  std::optional<std::size_t> drives{};  ///< Of each cell, in the place of the suite's own number.
  std::optional<std::size_t> scans{};   ///< Of each drive, likewise.
  std::filesystem::path
      data{};  ///< Where the public labelled sets lie; of the suites of labelled scans alone.
};

struct SuiteEntry {
  std::string_view name;
  std::string_view about;
  Suite (*make)(const SuiteRequest& request);
};

/// All suites in the order in which they are listed.
[[nodiscard]] std::span<const SuiteEntry> suites();

/// Throws std::invalid_argument that lists the names, or says why a suite's drives cannot be made.
[[nodiscard]] Suite suite_named(std::string_view name, const SuiteRequest& request);

}  // namespace verge::study
