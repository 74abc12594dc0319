// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <deque>
#include <optional>
#include <vector>

#include "verge/detect/road_width/corner_states.hpp"
#include "verge/detect/road_width/corner_tracks.hpp"
#include "verge/detect/road_width/road_lines.hpp"
#include "verge/detect/road_width/road_width.hpp"

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

/// What a scan did, for the trace.
struct WidthStep {
  CornerStep step{};    ///< Of the first pair of lines.
  std::size_t lag = 0;  ///< h.
};

/// Corners as the paper finds them: by the length of the first line against its own before, and against
/// another line's. Of four lines there are the pairs 1-4, 1-3, 1-2 and 2-4, each with its states; a corner is
/// found when so many of them as asked for are in one.
class WidthCorners {
 public:
  explicit WidthCorners(const RoadWidthConfig& config);

  /// The next scan: its lines, first to last (two at least), the way behind, and d_v where it is known.
  WidthStep see(const std::vector<Road>& roads, double way_m, std::optional<double> step_m,
                CornerTracks& tracks);

 private:
  [[nodiscard]] std::size_t lag_of(std::optional<double> step_m) const;
  [[nodiscard]] std::size_t pairs_in_corner() const;
  void add_corner(const FirstLine& first, double way_m, double step_m, CornerTracks& tracks) const;

  RoadWidthConfig config_;
  std::vector<CornerStates> pairs_;
  Widening widening_;
  bool in_corner_ = false;
};

}  // namespace verge::detect::road_width
