// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

namespace verge::detect::road_width {

/// "Experience numbers" of the corner detection (P1, corner Step 1).
struct CornerThresholds {
  double ds_m = 1.0;       ///< DS_thres: how much the first line must have grown since t - h.
  double dd_m = 1.0;       ///< DD_thres: how much longer the first line must be than the last one.
  std::size_t k = 2;       ///< K_thres: scans in a row, beyond which a corner is found.
  std::size_t misses = 0;  ///< Scans that may fail the second comparison without ending the state.
  double rest_m = 0.0;     ///< The next corner is not looked for before so much way behind the last one.
};

/// Lengths of the road lines at one time, metres.
struct LineLengths {
  double first_m = 0.0;  ///< L_far: of the farthest line.
  double last_m = 0.0;   ///< L_near: of the nearest line.
  double way_m = 0.0;    ///< Of the vehicle since the first scan; 0 where it is not known.
};

/// What a scan did to the states.
struct CornerStep {
  bool candidate = false;  ///< CCS: in corner-candidate state.
  std::size_t k = 0;       ///< K, behind Step 4.
  bool found = false;      ///< Step 7.
  bool left = false;       ///< The first line leaves the corner that was found (Fig. 3-3).
  double first_m = 0.0;    ///< First comparison: the first line less the last one.
  double second_m = 0.0;   ///< Second comparison: the first line less itself h scans before.
};

/// Corner Steps 1 to 7 of P1: the first line longer than the last opens the candidate state, the first line
/// longer than h scans ago confirms it. A corner that was found ends the state, and the next is not looked
/// for before the first line is again shorter than the straight road and DS_thres, and has gone on by
/// `rest_m` (the paper ends there).
class CornerStates {
 public:
  explicit CornerStates(const CornerThresholds& thresholds) : thresholds_(thresholds) {}

  /// The next scan; `lag` is h, in scans. Where the history is shorter, its begin is taken.
  CornerStep step(const LineLengths& lengths, std::size_t lag);

  /// Whether the first line is still in a corner that was found.
  [[nodiscard]] bool in_corner() const { return in_corner_; }

 private:
  [[nodiscard]] double before_m(std::size_t lag) const;
  void look_for_corner(const LineLengths& lengths, std::size_t lag, CornerStep& done);
  void look_for_exit(const LineLengths& lengths, std::size_t lag, CornerStep& done);

  CornerThresholds thresholds_;
  std::vector<double> first_m_;  // of all scans kept, oldest first
  bool candidate_ = false;
  bool in_corner_ = false;
  bool exit_seen_ = false;
  double straight_m_ = 0.0;  // length of the first line when the corner that was found began
  double found_way_m_ = 0.0;
  std::size_t k_ = 0;
  std::size_t missed_ = 0;
};

}  // namespace verge::detect::road_width
