// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/emit/geojson.hpp"

#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "verge/emit/jsonl_writer.hpp"
#include "verge/emit/scene_properties.hpp"

namespace verge::emit {
namespace {

using nlohmann::ordered_json;
using Position = std::vector<double>;
using Line = std::vector<Position>;

/// Degrees to 1e-9, which is 0.1 mm on the ground.
double rounded_degrees(double deg) { return std::round(deg * 1e9) / 1e9 + 0.0; }

/// The line in pieces that each stay on one side of the antimeridian (RFC 7946, 3.1.9). Two neighbours more
/// than half a turn apart are taken as meeting the short way.
std::vector<Line> cut_at_antimeridian(const Line& line) {
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

ordered_json geometry_of(const Line& line, bool geographic) {
  if (line.empty()) return nullptr;
  if (line.size() == 1) return {{"type", "Point"}, {"coordinates", line.front()}};
  const std::vector<Line> pieces = geographic ? cut_at_antimeridian(line) : std::vector<Line>{line};
  if (pieces.size() > 1) return {{"type", "MultiLineString"}, {"coordinates", pieces}};
  return {{"type", "LineString"}, {"coordinates", line}};
}

Line positions_of(const Boundary& boundary, const Pose& T_local_sensor,
                  const std::optional<GeoOrigin>& origin) {
  Line line;
  line.reserve(boundary.points.size());
  for (const Vec3 p_sensor : boundary.points) {
    const Vec3 p = T_local_sensor * p_sensor;
    if (origin) {
      const LonLat place = to_wgs84(*origin, p);
      line.push_back({rounded_degrees(place.longitude_deg), rounded_degrees(place.latitude_deg)});
    } else {
      line.push_back({rounded(p.x), rounded(p.y)});
    }
  }
  return line;
}

ordered_json feature_properties(const Scene& scene, const Boundary& boundary) {
  ordered_json properties{{"frame", scene.frame}, {"stamp_ns", nullptr}, {"stamp_ns_text", nullptr}};
  if (scene.stamp_ns) {
    properties["stamp_ns"] = *scene.stamp_ns;
    properties["stamp_ns_text"] = std::to_string(*scene.stamp_ns);
  }
  properties["frame_id"] = scene.frame_id;
  properties.update(properties_of(boundary));
  add_point_properties(properties, boundary);
  add_origin(properties, scene);
  return properties;
}

/// The collection up to its first feature.
std::string head_of(const std::optional<GeoOrigin>& origin, bool moved_by_poses) {
  ordered_json head{{"type", "FeatureCollection"}, {"schema", 1}};
  const std::string whose = moved_by_poses ? "the first scan's sensor" : "each scan's sensor";
  if (origin) {
    head["coordinate_frame"] = "WGS 84: longitude, latitude in degrees";
    head["origin"] = {{"latitude_deg", origin->latitude_deg},
                      {"longitude_deg", origin->longitude_deg},
                      {"heading_deg", origin->heading_deg},
                      {"of", whose}};
  } else {
    head["coordinate_frame"] = "local metres, not longitude and latitude: x forward, y left of " + whose;
  }
  std::string text = text_of(head);
  text.pop_back();  // the closing brace
  return text + ",\"features\":[";
}

void check(const GeoOrigin& origin) {
  const bool good = std::fabs(origin.latitude_deg) <= 90.0 && std::fabs(origin.longitude_deg) <= 180.0 &&
                    std::fabs(origin.heading_deg) <= 360.0;
  if (!good) throw std::invalid_argument("the origin's latitude, longitude or heading is out of range");
}

}  // namespace

GeoJsonWriter::GeoJsonWriter(AtomicFile file, const std::optional<GeoOrigin>& origin)
    : file_(std::move(file)), origin_(origin) {}

Expected<GeoJsonWriter> GeoJsonWriter::open(const std::filesystem::path& target,
                                            const std::optional<GeoOrigin>& origin) {
  if (origin) check(*origin);
  return open_output(target).map([&](AtomicFile&& file) { return GeoJsonWriter(std::move(file), origin); });
}

std::optional<Pose> GeoJsonWriter::place(const std::optional<Pose>& T_world_sensor) const {
  if (!T_local_world_) return Pose{};
  if (!T_world_sensor) return std::nullopt;
  return *T_local_world_ * *T_world_sensor;
}

Expected<void> GeoJsonWriter::write(const Scene& scene, const std::optional<Pose>& T_world_sensor) {
  std::string text;
  if (!begun_) {
    begun_ = true;
    if (T_world_sensor) T_local_world_ = inverse(*T_world_sensor);
    text = head_of(origin_, T_local_world_.has_value());
  }
  const std::optional<Pose> T_local_sensor = place(T_world_sensor);
  for (const Boundary& boundary : scene.boundaries) {
    const Line line = T_local_sensor ? positions_of(boundary, *T_local_sensor, origin_) : Line{};
    const ordered_json feature{{"type", "Feature"},
                               {"geometry", geometry_of(line, origin_.has_value())},
                               {"properties", feature_properties(scene, boundary)}};
    text += std::exchange(has_feature_, true) ? ",\n" : "\n";
    text += text_of(feature);
  }
  return put(text);
}

Expected<void> GeoJsonWriter::put(const std::string& text) {
  return file_.write(text).and_then([this] { return file_.flush(); });
}

Expected<void> GeoJsonWriter::finish() {
  const std::string head = begun_ ? std::string() : head_of(origin_, false);
  return put(head + "\n]}\n").and_then([this] { return file_.commit(); });
}

}  // namespace verge::emit
