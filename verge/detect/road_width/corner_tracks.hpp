// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <deque>
#include <optional>
#include <vector>

#include "verge/model/scene.hpp"

namespace verge::detect::road_width {

/// What a scan says of the first line.
struct FirstLine {
  double length_m = 0.0;
  double left_m = 0.0;   ///< From the vehicle's axis to its left end, cut at the reach.
  double right_m = 0.0;  ///< Likewise.
  double ahead_m = 0.0;  ///< y_f: where it meets the road.
};

/// The first line from scan to scan, over the way: when it began to widen, and what the straight road is.
class Widening {
 public:
  explicit Widening(double widened_m) : widened_m_(widened_m) {}

  /// The next scan, `way_m` beyond the first one.
  void see(const FirstLine& line, double way_m);

  /// n_0: the way at the first scan of the run of scans that are widened; none where the last one is not.
  [[nodiscard]] std::optional<double> began_m() const { return began_m_; }
  /// The straight road's medians; those of the first scan before there are others.
  [[nodiscard]] const FirstLine& straight() const { return straight_; }

 private:
  double widened_m_;
  std::deque<FirstLine> history_;  // of scans that are not widened, oldest first
  FirstLine straight_;
  std::size_t widened_scans_ = 0;
  std::optional<double> began_m_;
};

/// Corners that were found, until they are reached (A0.4: from the triangle relations).
class CornerTracks {
 public:
  /// A corner is found at the way `way_m`, `step_m` behind the last scan: the first line began to widen at
  /// the way `began_m`. Where both sides widened, there is one on each.
  void add(const FirstLine& line, const FirstLine& straight, double began_m, double way_m, double step_m,
           double ds_thres_m);
  /// Those still ahead at `way_m`, in the level frame.
  [[nodiscard]] std::vector<Corner> ahead(double way_m);

 private:
  struct Track {
    Corner corner;
    double at_m = 0.0;  // of the entrance along the way
  };

  std::vector<Track> tracks_;
  int next_id_ = 0;
};

}  // namespace verge::detect::road_width
