// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/detect/road_width/layers.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <span>

#include "verge/core/angle.hpp"
#include "verge/core/statistics.hpp"
#include "verge/detect/road_width/layer_geometry.hpp"

namespace verge::detect::road_width {
namespace {

constexpr std::size_t kLines = 4;

bool is_usable(const Scan& scan, std::size_t i) {
  return (scan.echo.empty() || scan.echo[i] == 0) && scan.range[i] > 0.0F;
}

double typical_step_rad(const std::vector<double>& azimuth) {
  std::vector<double> steps;
  for (std::size_t i = 1; i < azimuth.size(); ++i) steps.push_back(std::fabs(azimuth[i] - azimuth[i - 1]));
  return median(steps).value_or(0.0);
}

/// The ring's points from left to right, beginning straight behind: azimuths fall.
std::vector<std::size_t> from_left(const Scan& scan, std::size_t ring, double forward_rad) {
  const auto [begin, end] = scan.ring(ring);
  const double behind_rad =
      forward_rad > 0.0 ? forward_rad - std::numbers::pi : forward_rad + std::numbers::pi;
  const auto azimuths = std::span(scan.azimuth).subspan(begin, end - begin);
  const auto split =
      begin + static_cast<std::size_t>(std::upper_bound(azimuths.begin(), azimuths.end(), behind_rad) -
                                       azimuths.begin());
  std::vector<std::size_t> order;
  order.reserve(end - begin);
  for (std::size_t i = split; i-- > begin;) order.push_back(i);
  for (std::size_t i = end; i-- > split;) order.push_back(i);
  return order;
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
    if (std::fabs(from_road_rad) > side_rad || !is_usable(scan, i)) continue;
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

/// Whether the line meets the road straight ahead, and not what stands on it or the sky.
bool meets_road(const LayerLine& line) {
  constexpr double kRoad_m = 0.3;
  return line.tangent > 0.0 && std::fabs(line.level[line.middle].z) <= kRoad_m;
}

/// Of more lines (nearest first), those nearest to where the four would be, in order.
std::vector<LayerLine> stand_ins(std::vector<LayerLine> all, const RoadWidthConfig& config) {
  std::vector<LayerLine> chosen;
  std::size_t next = 0;
  for (std::size_t i = 0; i < kLines; ++i) {
    const double part = static_cast<double>(i) / (kLines - 1);
    const double tangent = std::tan(config.nearest_rad + part * config.span_rad);
    const std::size_t last = all.size() - (kLines - 1 - i);  // so that each of the others gets one
    std::size_t best = next;
    for (std::size_t k = next; k < last; ++k) {
      if (std::fabs(all[k].tangent - tangent) < std::fabs(all[best].tangent - tangent)) best = k;
    }
    chosen.push_back(std::move(all[best]));
    next = best + 1;
  }
  return chosen;
}

}  // namespace

std::vector<LayerLine> four_lines(const Scan& scan, const LevelFrame& frame, const Mount& mount,
                                  const RoadWidthConfig& config) {
  std::vector<LayerLine> lines;
  if (!(mount.height_m > 0.0)) return lines;
  const bool is_four_layer = scan.ring_count() <= kLines;
  for (std::size_t ring = 0; ring < scan.ring_count(); ++ring) {
    auto line = line_of(scan, ring, frame, mount, config.side_rad);
    if (line && (is_four_layer || meets_road(*line))) lines.push_back(*std::move(line));
  }
  if (lines.size() > kLines) lines = stand_ins(std::move(lines), config);
  std::ranges::reverse(lines);
  return lines;
}

}  // namespace verge::detect::road_width
