// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/detect/line_fit/layer_points.hpp"

#include <cmath>

#include "verge/core/angle.hpp"
#include "verge/scan/four_layers.hpp"

namespace verge::detect::line_fit {

std::vector<LayerPoint> layer_points(const Scan& scan, const LevelFrame& frame, const Mount& mount,
                                     const LayerPointsConfig& config) {
  std::vector<LayerPoint> points;
  const auto rings =
      rings_of_four_layers(scan, frame, mount, {config.nearest_rad, config.span_rad, config.side_rad});
  for (std::size_t layer = 0; layer < rings.size(); ++layer) {
    for (const std::size_t i : from_left(scan, rings[layer], mount.forward_rad)) {
      const double range_m = scan.range[i];
      const double azimuth_rad = wrap_pi(double{scan.azimuth[i]} - mount.forward_rad);
      const bool is_within = range_m > 0.0 && range_m < config.range_max_m;
      if (!is_within || std::fabs(azimuth_rad) > config.side_rad) continue;
      points.push_back({frame.to_level(scan.point(i)), layer, azimuth_rad, range_m, i});
    }
  }
  return points;
}

std::vector<std::pair<std::size_t, std::size_t>> layers_of(std::span<const LayerPoint> points) {
  std::vector<std::pair<std::size_t, std::size_t>> layers;
  for (std::size_t begin = 0, end = 0; begin < points.size(); begin = end) {
    while (end < points.size() && points[end].layer == points[begin].layer) ++end;
    layers.emplace_back(begin, end);
  }
  return layers;
}

std::vector<Vec2> places_of(std::span<const LayerPoint> points) {
  std::vector<Vec2> places;
  places.reserve(points.size());
  for (const LayerPoint& p : points) places.push_back(p.place.xy());
  return places;
}

}  // namespace verge::detect::line_fit
