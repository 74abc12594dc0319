// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/detect/gradient/scan_lines.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
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

/// Whether a scan line anywhere comes down to where a boundary may stand; those that meet walls alone do not.
bool comes_down(const LowRing& ring, const GradientConfig& config) {
  return std::ranges::any_of(ring.points, [&](Vec3 p) { return p.z < config.obstacle_m; });
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
  lines.reserve(kQuadrants.size() * low.size());
  for (const bool front : {true, false}) {
    RoadAxis axis(front);
    for (const LowRing& ring : low) {
      if (!comes_down(ring, config)) continue;
      axis.advance(ring);
      std::array<std::optional<Vec2>, 2> feet;
      std::size_t side = 0;
      for (Layer& part : parts_of(ring, front, axis.direction())) {
        lines.push_back(scan_line(std::move(part), obstacles, config));
        if (const auto& met = lines.back().candidate) feet[side] = met->foot.xy();
        ++side;
      }
      axis.follow(feet[0], feet[1]);
    }
  }
  return lines;
}

std::vector<Candidate> candidates_in(const std::vector<ScanLine>& lines, Quadrant region) {
  std::vector<Candidate> candidates;
  for (const ScanLine& line : lines) {
    if (line.layer.region == region && line.candidate) candidates.push_back(*line.candidate);
  }
  return candidates;
}

}  // namespace verge::detect::gradient
