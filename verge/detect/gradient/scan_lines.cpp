// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/detect/gradient/scan_lines.hpp"

#include <array>
#include <utility>

#include "verge/detect/gradient/road_axis.hpp"

namespace verge::detect::gradient {
namespace {

/// II-1 (2) and (3), K and clusters, of one scan line, as printed.
ScanLine scan_line_as_printed(Layer layer, const GradientConfig& config) {
  auto points = gradient_points_as_printed(layer, config);
  auto clusters = cluster_layer(layer, points, config);
  return {std::move(layer), std::move(points), std::move(clusters), std::nullopt};
}

/// The same, fixed reading, and where it meets the boundary.
ScanLine scan_line(Layer layer, const Obstacles& obstacles, const GradientConfig& config) {
  auto points = gradient_points(layer, config);
  auto clusters = cluster_layer(layer, points, config);
  auto candidate = first_outward(layer, points, clusters, obstacles, config);
  return {std::move(layer), std::move(points), std::move(clusters), candidate};
}

}  // namespace

std::vector<ScanLine> scan_lines_as_printed(const std::vector<LowRing>& low, const GradientConfig& config) {
  std::vector<ScanLine> lines;
  for (Layer& layer : split_quadrants(low)) lines.push_back(scan_line_as_printed(std::move(layer), config));
  return lines;
}

std::vector<ScanLine> scan_lines(const std::vector<LowRing>& low, const Obstacles& obstacles,
                                 const GradientConfig& config) {
  std::vector<ScanLine> lines;
  for (const bool front : {true, false}) {
    RoadAxis axis(front);
    for (const LowRing& ring : low) {
      const std::vector<Vec3> half = half_of(ring, front);
      axis.advance(half);
      const Vec2 direction = axis.direction();
      std::array<std::optional<Vec2>, 2> feet;
      for (const bool right : {false, true}) {
        lines.push_back(scan_line(part_of(ring, half, front, right, direction), obstacles, config));
        if (const auto& met = lines.back().candidate) feet[right ? 1 : 0] = met->foot.xy();
      }
      axis.follow(feet[0], feet[1]);
    }
  }
  return lines;
}

}  // namespace verge::detect::gradient
