// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/emit/geojson_geometry.hpp"

#include <algorithm>
#include <cmath>

#include "verge/emit/scene_properties.hpp"

namespace verge::emit {
namespace {

using nlohmann::ordered_json;

/// Degrees to 1e-9, which is 0.1 mm on the ground.
double rounded_degrees(double deg) { return std::round(deg * 1e9) / 1e9 + 0.0; }

/// Twice the area of the ring: positive where it runs counter-clockwise.
double doubled_area(const std::vector<std::vector<double>>& ring) {
  double sum = 0.0;
  for (std::size_t i = 1; i < ring.size(); ++i) {
    sum += ring[i - 1][0] * ring[i][1] - ring[i][0] * ring[i - 1][1];
  }
  return sum;
}

}  // namespace

/// The line in pieces that each stay on one side of the antimeridian (RFC 7946, 3.1.9). Two neighbours more
/// than half a turn apart are taken as meeting the short way.
std::vector<GeoPlacer::Line> GeoPlacer::cut_at_antimeridian(const Line& line) {
  std::vector<Line> pieces(1);
  for (const Position& next : line) {
    Line& piece = pieces.back();
    if (!piece.empty() && std::fabs(next[0] - piece.back()[0]) > 180.0) {
      const Position& last = piece.back();
      const double edge = std::copysign(180.0, last[0]);
      const double t = (edge - last[0]) / (next[0] + 2.0 * edge - last[0]);
      const double latitude = rounded_degrees(last[1] + t * (next[1] - last[1]));
      piece.push_back(Position{edge, latitude});
      pieces.push_back(Line{Position{-edge, latitude}});
    }
    pieces.back().push_back(next);
  }
  return pieces;
}

GeoPlacer::Line GeoPlacer::positions(std::span<const Vec3> points) const {
  Line line;
  if (!T_local_sensor_) return line;
  line.reserve(points.size());
  for (const Vec3 p_sensor : points) {
    const Vec3 p = *T_local_sensor_ * p_sensor;
    if (origin_) {
      const LonLat place = to_wgs84(*origin_, p);
      line.push_back({rounded_degrees(place.longitude_deg), rounded_degrees(place.latitude_deg)});
    } else {
      line.push_back({rounded(p.x), rounded(p.y)});
    }
  }
  return line;
}

ordered_json GeoPlacer::geometry_of(const Line& line) const {
  if (line.empty()) return nullptr;
  if (line.size() == 1) return {{"type", "Point"}, {"coordinates", line.front()}};
  const std::vector<Line> pieces = origin_ ? cut_at_antimeridian(line) : std::vector<Line>{line};
  if (pieces.size() > 1) return {{"type", "MultiLineString"}, {"coordinates", pieces}};
  return {{"type", "LineString"}, {"coordinates", line}};
}

ordered_json GeoPlacer::line(std::span<const Vec3> points) const { return geometry_of(positions(points)); }

ordered_json GeoPlacer::polygon(std::span<const Vec3> corners) const {
  Line ring = positions(corners);
  if (ring.size() < 3) return geometry_of(ring);
  ring.push_back(ring.front());
  if (origin_ && cut_at_antimeridian(ring).size() > 1) return geometry_of(ring);
  if (doubled_area(ring) < 0.0) std::reverse(ring.begin(), ring.end());  // RFC 7946, 3.1.6
  return {{"type", "Polygon"}, {"coordinates", std::vector<Line>{ring}}};
}

}  // namespace verge::emit
