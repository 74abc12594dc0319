// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/detect/road_width/road_lines.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

#include "verge/core/statistics.hpp"
#include "verge/detect/road_width/kerb_foot.hpp"

namespace verge::detect::road_width {
namespace {

/// K: what fits the window's width.
std::size_t neighbours_of(const LayerLine& line, const RoadWidthConfig& config) {
  if (config.neighbours > 0) return static_cast<std::size_t>(config.neighbours);
  if (!(line.step_rad > 0.0)) return 1;
  return static_cast<std::size_t>(std::max(1.0, std::round(config.neighbours_rad / line.step_rad)));
}

/// Mean square of what one point is off along the road, m^2, by how much the points about the middle differ
/// from the mean of their neighbours. Half of them may be anything.
double noise_m2(const LayerLine& line) {
  constexpr std::size_t kAbout = 32;
  constexpr double kMedianOfSquares = 0.4549;  // of a Gaussian variable of variance 1
  const std::vector<PicturePoint>& points = line.points;
  const std::size_t begin = line.middle > kAbout ? line.middle - kAbout : 0;
  const std::size_t end = std::min(line.middle + kAbout, points.size());
  std::vector<double> squares;
  for (std::size_t i = begin + 1; i + 1 < end; ++i) {
    const double off_m = points[i].y - 0.5 * (points[i - 1].y + points[i + 1].y);
    squares.push_back(off_m * off_m / 1.5);
  }
  return median(squares).value_or(0.0) / kMedianOfSquares;
}

LineSearch search_of(const LayerLine& line, const RoadWidthConfig& config) {
  LineSearch search{.neighbours = neighbours_of(line, config),
                    .y_thres_m2 = config.y_thres_m2,
                    .x_thres_m2 = config.x_thres_m2,
                    .tangent = line.tangent};
  const bool printed = config.is_printed();
  if (!printed) search.y_thres_m2 = std::max(config.y_thres_m2, config.noise_factor * noise_m2(line));
  search.refine = !printed;
  search.bridge = printed ? 0 : static_cast<std::size_t>(config.bridge);
  search.obstacle_m = printed ? std::numeric_limits<double>::infinity() : config.obstacle_m;
  return search;
}

Vec3 end_place(const LayerLine& line, const RoadEnd& end, bool left, const RoadWidthConfig& config) {
  const Vec3 last = line.level[end.edge];
  if (config.reading != CornerReading::kCombined || end.kind == LineEnd::kOpen) return last;
  const Vec2 foot = kerb_foot(line, end.edge, left).value_or(last.xy());
  return {foot.x, foot.y, last.z};
}

}  // namespace

std::vector<Road> road_lines(std::vector<LayerLine> lines, const RoadWidthConfig& config) {
  std::vector<Road> roads;
  for (LayerLine& line : lines) {
    const auto road = find_road_line(line.points, line.middle, search_of(line, config));
    if (!road) continue;
    const Vec3 left = end_place(line, road->left, true, config);
    const Vec3 right = end_place(line, road->right, false, config);
    roads.push_back({std::move(line), *road, left, right});
  }
  return roads;
}

double reach_m(const std::vector<Road>& roads, const RoadWidthConfig& config) {
  const LayerLine& last = roads.back().line;
  return std::min(config.reach_m, last.points[last.middle].y * std::tan(config.side_rad));
}

double length_m(const Road& road, double reach_m) {
  return road_length_m(road.line.points, road.road, reach_m);
}

}  // namespace verge::detect::road_width
