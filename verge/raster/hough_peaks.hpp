// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "verge/raster/grid.hpp"
#include "verge/raster/hough.hpp"

namespace verge::raster {

struct PeakOptions {
  int most = 10;             ///< So many peaks at most ("a specific number of peaks", paper 2, V-A; P2-13).
  double least_share = 0.3;  ///< A peak has at least this share of the greatest count.
  /// Around a peak no second one is found: this share of the rho range to either side ...
  double rho_share = 0.01;
  double theta_deg = 3.0;  ///< ... and so many degrees.
};

/// A line of the picture that many marked pixels lie on.
struct HoughPeak {
  double theta_rad = 0.0;  ///< In [-pi/2, pi/2), clockwise from the picture's +x to the line's perpendicular.
  int rho_px = 0;          ///< x cos(theta) + y sin(theta), x = column, y = row.
  int count = 0;           ///< Marked pixels in its bin.

  friend bool operator==(const HoughPeak&, const HoughPeak&) = default;
};

/// The greatest count, then the greatest away from it, and so on; of equals the one of least theta, then of
/// least rho. The neighbourhood goes on from theta = 90 degrees to -90, where rho changes its sign: a line is
/// the same after a half turn. Pictures without marks have none. (Settled reading 18)
[[nodiscard]] std::vector<HoughPeak> hough_peaks(const Accumulator& accumulator,
                                                 const PeakOptions& options = {});

}  // namespace verge::raster
