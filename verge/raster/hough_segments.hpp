// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "verge/core/vec.hpp"
#include "verge/raster/grid.hpp"
#include "verge/raster/hough_peaks.hpp"
#include "verge/raster/picture.hpp"

namespace verge::raster {

/// A line in metres by its perpendicular: x sin(theta) + y cos(theta) = distance_m.
struct NormalLine {
  double theta_rad = 0.0;
  double distance_m = 0.0;

  /// Unit vector along the line, forward (to the left, where theta is -90 degrees).
  [[nodiscard]] Vec2 along() const;
  /// Metres, positive to the left of `along`.
  [[nodiscard]] double signed_distance(Vec2 p) const;
  /// The line's point nearest to p.
  [[nodiscard]] Vec2 foot(Vec2 p) const;
};

/// A peak's line in metres: X sin(theta) + Y cos(theta) = Y_max cos(theta) + X_max sin(theta) - r rho (A1.5).
[[nodiscard]] NormalLine to_metres(const HoughPeak& peak, const Grid& grid);

struct SegmentOptions {
  double fill_gap_m = 3.0;    ///< Gaps up to this are filled.
  double min_length_m = 4.0;  ///< Shorter segments are dropped.
  bool max_len = false;       ///< Only the longest of each peak, of equals the rearmost (P2-13; A1.3 l).
};

struct HoughSegment {
  Vec2 from;  ///< Rear end (right end, where the line goes straight across), metres, on the peak's line.
  Vec2 to;    ///< The other end.
  std::size_t peak = 0;  ///< Which of the peaks it lies on.
  int pixels = 0;        ///< Marked pixels of the peak's bin that it goes through.

  [[nodiscard]] double length_m() const { return distance(from, to); }
};

/// The stretches of each peak's line that the picture marks: its pixels in the peak's bin, in order along the
/// line, up to the next gap that is longer than fill_gap_m. Ends are feet of pixels' centres. In the order of
/// the peaks, and of each from the rear to the front. `peaks` are those of this picture, `grid` is its own.
[[nodiscard]] std::vector<HoughSegment> hough_segments(const Picture& picture, const Grid& grid,
                                                       std::span<const HoughPeak> peaks,
                                                       const SegmentOptions& options = {});

}  // namespace verge::raster
