// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/detect/road_width/opening.hpp"

#include <algorithm>
#include <cstddef>
#include <vector>

#include "verge/core/statistics.hpp"

namespace verge::detect::road_width {
namespace {

constexpr std::size_t kInARow = 2;

bool is_beyond(const KerbPoint& point, double widened_m) { return point.outward_m > widened_m; }

double depth_m(std::span<const KerbPoint> points, double from_m) {
  std::vector<double> outward;
  for (const KerbPoint& point : points) {
    if (point.along_m >= from_m) outward.push_back(point.outward_m);
  }
  return median(outward).value_or(0.0);
}

}  // namespace

std::optional<Opening> last_opening(std::span<const KerbPoint> points, double widened_m) {
  std::optional<Opening> opening;
  std::optional<double> inside_m;
  std::size_t beyond = 0;
  std::size_t inside = kInARow;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const KerbPoint& point = points[i];
    if (!is_beyond(point, widened_m)) {
      beyond = 0;
      if (++inside >= kInARow) {
        opening.reset();
        inside_m = point.along_m;
      }
      continue;
    }
    inside = 0;
    if (++beyond == kInARow && !opening && inside_m)
      opening = Opening{*inside_m, points[i - 1].along_m, point.along_m, 0.0};
    if (opening) opening->last_m = point.along_m;
  }
  if (opening) opening->depth_m = depth_m(points, 0.5 * (opening->first_m + opening->last_m));
  return opening;
}

std::optional<double> end_of_opening(std::span<const KerbPoint> points, double from_m, double widened_m) {
  double beyond_m = from_m;
  std::size_t inside = 0;
  double first_inside_m = from_m;
  for (const KerbPoint& point : points) {
    if (point.along_m < from_m) continue;
    if (is_beyond(point, widened_m)) {
      beyond_m = point.along_m;
      inside = 0;
      continue;
    }
    if (++inside == 1) first_inside_m = point.along_m;
    if (inside >= kInARow) return 0.5 * (beyond_m + first_inside_m);
  }
  return std::nullopt;
}

}  // namespace verge::detect::road_width
