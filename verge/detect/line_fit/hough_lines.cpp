// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/detect/line_fit/hough_lines.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "verge/fit/path.hpp"
#include "verge/raster/edges.hpp"
#include "verge/raster/squares.hpp"

namespace verge::detect::line_fit {
namespace {

raster::Grid grid_around(std::span<const Vec2> points, const LineFitConfig& config) {
  const double margin_m = static_cast<double>(config.square_px) * config.cell_m;
  Vec2 low = points.front();
  Vec2 high = points.front();
  for (const Vec2 p : points) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y)};
  }
  const Vec2 margin{margin_m, margin_m};
  return raster::grid_over(low - margin, high + margin, config.cell_m);
}

/// The points along the segment and not farther from the line than that.
std::vector<std::size_t> points_on(const raster::HoughSegment& segment, const fit::Line& line,
                                   std::span<const Vec2> places, std::span<const std::size_t> chosen,
                                   double near_m) {
  std::vector<std::size_t> on;
  const double from_m = fit::station(line, segment.from) - near_m;
  const double to_m = fit::station(line, segment.to) + near_m;
  for (const std::size_t i : chosen) {
    const double station_m = fit::station(line, places[i]);
    if (station_m >= std::min(from_m, to_m) && station_m <= std::max(from_m, to_m) &&
        std::fabs(fit::signed_distance(line, places[i])) <= near_m)
      on.push_back(i);
  }
  return on;
}

/// Twice, the second time closer: squares make bands of lines, in which the peaks' lines are askew.
std::optional<Edge> refit(const raster::HoughSegment& segment, std::span<const Vec2> places,
                          std::span<const std::size_t> chosen, const LineFitConfig& config) {
  const double square_m = static_cast<double>(config.square_px) * config.cell_m;
  const std::array ends = {segment.from, segment.to};
  auto line = fit::orthogonal_line(ends);
  std::vector<std::size_t> on;
  for (const double near_m : {square_m, 0.5 * square_m}) {
    if (!line) return std::nullopt;
    on = points_on(segment, *line, places, chosen, near_m);
    line = fit::orthogonal_line(fit::gather(places, on));
  }
  if (!line) return std::nullopt;
  return edge_of(*line, std::move(on), places);
}

raster::EdgeOptions filter_of(const LineFitConfig& config) {
  return {.filter = config.is_printed() ? raster::EdgeFilter::kCanny : config.edge_filter,
          .gaussian_px = config.gaussian_px};
}

}  // namespace

HoughSteps hough_lines(std::span<const Vec2> places, std::span<const std::size_t> chosen,
                       const LineFitConfig& config) {
  HoughSteps steps;
  if (chosen.empty()) return steps;
  static const raster::HoughTransform kTransform;
  const std::vector<Vec2> points = fit::gather(places, chosen);
  steps.grid = grid_around(points, config);
  steps.squares = raster::mark_squares(points, steps.grid, static_cast<int>(config.square_px));
  steps.edges = raster::find_edges(steps.squares, filter_of(config));
  steps.accumulator = kTransform(steps.edges);
  steps.peaks = raster::hough_peaks(
      steps.accumulator, {.most = static_cast<int>(config.peaks), .least_share = config.peak_share});
  steps.segments = raster::hough_segments(
      steps.edges, steps.grid, steps.peaks,
      {.fill_gap_m = config.fill_gap_m, .min_length_m = config.min_length_m, .max_len = config.max_len});
  for (const raster::HoughSegment& segment : steps.segments) {
    if (auto edge = refit(segment, places, chosen, config)) steps.lines.push_back(*std::move(edge));
  }
  return steps;
}

}  // namespace verge::detect::line_fit
