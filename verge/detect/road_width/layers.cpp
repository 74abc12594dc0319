// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/detect/road_width/layers.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "verge/core/angle.hpp"
#include "verge/core/statistics.hpp"
#include "verge/scan/four_layers.hpp"

namespace verge::detect::road_width {
namespace {

double typical_step_rad(const std::vector<double>& azimuth) {
  std::vector<double> steps;
  for (std::size_t i = 1; i < azimuth.size(); ++i) steps.push_back(std::fabs(azimuth[i] - azimuth[i - 1]));
  return median(steps).value_or(0.0);
}

/// None where the ring has no point ahead.
std::optional<LayerLine> line_of(const Scan& scan, std::size_t ring, const LevelFrame& frame,
                                 const Mount& mount, double side_rad) {
  LayerLine line;
  std::vector<double> azimuth;
  const std::vector<std::size_t> order = from_left(scan, ring, mount.forward_rad);
  line.points.reserve(order.size());
  line.level.reserve(order.size());
  azimuth.reserve(order.size());
  for (const std::size_t i : order) {
    const double from_road_rad = wrap_pi(double{scan.azimuth[i]} - mount.forward_rad);
    if (std::fabs(from_road_rad) > side_rad || !is_first_echo(scan, i)) continue;
    const Vec3 p = frame.to_level(scan.point(i));
    line.points.push_back({-p.y, p.x});
    line.level.push_back(p);
    azimuth.push_back(from_road_rad);
  }
  if (azimuth.empty()) return std::nullopt;
  const auto ahead = std::ranges::min_element(azimuth, {}, [](double a) { return std::fabs(a); });
  line.middle = static_cast<std::size_t>(ahead - azimuth.begin());
  line.tangent = line.points[line.middle].y / mount.height_m;
  line.step_rad = typical_step_rad(azimuth);
  return line;
}

}  // namespace

std::vector<LayerLine> four_lines(const Scan& scan, const LevelFrame& frame, const Mount& mount,
                                  const RoadWidthConfig& config) {
  std::vector<LayerLine> lines;
  if (!(mount.height_m > 0.0)) return lines;
  const FourLayers layers{config.nearest_rad, config.span_rad, config.side_rad};
  for (const std::size_t ring : rings_of_four_layers(scan, frame, mount, layers)) {
    auto line = line_of(scan, ring, frame, mount, config.side_rad);
    if (line) lines.push_back(*std::move(line));
  }
  std::ranges::reverse(lines);
  return lines;
}

}  // namespace verge::detect::road_width
