// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "verge/eval/corner_score.hpp"
#include "verge/eval/label_score.hpp"
#include "verge/eval/scene_evaluation.hpp"
#include "verge/study/histogram.hpp"

namespace verge::study {

/// A scan that can be made or read again, and how well its boundaries were found.
struct ScanScore {
  double f1 = 0.0;
  std::uint64_t drive = 0;  ///< Number of the drive; 0 of a labelled set.
  std::uint64_t scan = 0;   ///< Its index on the drive, or its place in the set.
  std::string frame;

  friend bool operator==(const ScanScore&, const ScanScore&) = default;
};

/// All that one method's results on some scans came to. Tallies of parts add up to that of the whole; what a
/// suite does not judge stays empty.
struct Tally {
  std::size_t scans = 0;
  std::size_t absent = 0;   ///< Scans without a prediction.
  std::size_t damaged = 0;  ///< Scans that could not be read.
  std::vector<eval::ToleranceCell> cells;
  eval::RangeBins by_range;
  std::vector<eval::ConfidencePoint> by_confidence;
  eval::StationCounts stations;
  eval::SuccessCounts straight;
  eval::SuccessCounts curve;
  Histogram lateral_m;                        ///< Signed, + is outward.
  std::vector<Histogram> lateral_by_range_m;  ///< Rings as wide as those of by_range.
  Histogram heading_rad{1e-4};
  eval::ObjectScore objects;
  eval::CornerScore corners;
  eval::LabelScore labels;
  eval::SuccessCounts labelled;    ///< Of labelled scans.
  Histogram seconds{1e-5};         ///< Mount and detection of a scan, by the clock.
  std::vector<ScanScore> poorest;  ///< One a part: its scan of the least F1.

  Tally& operator+=(const Tally& more);
};

/// Adds what a scan's evaluation says.
void add_scene(Tally& tally, const eval::SceneEvaluation& scan);
/// Keeps the poorer of this scan and the part's poorest so far.
void note_poorest(Tally& tally, ScanScore scan);

}  // namespace verge::study
