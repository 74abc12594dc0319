// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "verge/core/vec.hpp"
#include "verge/detect/line_fit/edge_curve.hpp"
#include "verge/raster/grid.hpp"
#include "verge/raster/hough.hpp"
#include "verge/raster/hough_peaks.hpp"
#include "verge/raster/hough_segments.hpp"
#include "verge/raster/picture.hpp"

namespace verge::detect::line_fit {

/// What the Hough chain made of points, step by step (P2 III-A, V-A; Fig. 15, 16).
struct HoughSteps {
  raster::Grid grid;
  raster::Picture squares;
  raster::Picture edges;
  raster::Accumulator accumulator;
  std::vector<raster::HoughPeak> peaks{};
  std::vector<raster::HoughSegment> segments{};
  std::vector<Edge> lines{};  ///< The segments, put through the points near to them again.
};

/// Squares, edges, accumulator, peaks, segments, and a line by orthogonal least squares through the points
/// within a square's reach of each segment. `chosen` are indices into `places`; without any, all is empty.
[[nodiscard]] HoughSteps hough_lines(std::span<const Vec2> places, std::span<const std::size_t> chosen,
                                     const LineFitConfig& config);

}  // namespace verge::detect::line_fit
