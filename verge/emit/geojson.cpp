// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/emit/geojson.hpp"

#include <array>
#include <cmath>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "verge/emit/geojson_geometry.hpp"
#include "verge/emit/jsonl_writer.hpp"
#include "verge/emit/scene_properties.hpp"

namespace verge::emit {
namespace {

using nlohmann::ordered_json;
/// A feature before its frame's own properties are added: where it is, and what it is.
struct Feature {
  ordered_json geometry;
  ordered_json properties;
};

template <class Part>
ordered_json named_properties(std::string_view name, const Part& part) {
  ordered_json properties{{"part", name}};
  properties.update(properties_of(part));
  return properties;
}

Feature feature_of(const Boundary& boundary, const GeoPlacer& placer) {
  ordered_json properties = named_properties("boundary", boundary);
  add_point_properties(properties, boundary);
  return {placer.line(boundary.points), std::move(properties)};
}

Vec3 flat(Vec2 p) { return {p.x, p.y, 0.0}; }

Feature feature_of(const Opening& opening, const GeoPlacer& placer) {
  const std::array ends{flat(opening.ends[0]), flat(opening.ends[1])};
  return {placer.line(ends), named_properties("opening", opening)};
}

Feature feature_of(const Corner& corner, const GeoPlacer& placer) {
  return {placer.line(std::array{flat(corner.position)}), named_properties("corner", corner)};
}

Feature feature_of(const Junction& junction, const GeoPlacer& placer) {
  return {placer.line(std::array{flat(junction.center)}), named_properties("junction", junction)};
}

/// The object's footprint.
Feature feature_of(const Object& object, const GeoPlacer& placer) {
  const Pose T_sensor_object{from_yaw_pitch_roll(object.yaw_rad, 0.0, 0.0), object.center};
  const double x = 0.5 * object.size.length_m;
  const double y = 0.5 * object.size.width_m;
  std::vector<Vec3> corners;
  for (const Vec3 corner : {Vec3{x, y, 0.0}, Vec3{-x, y, 0.0}, Vec3{-x, -y, 0.0}, Vec3{x, -y, 0.0}}) {
    corners.push_back(T_sensor_object * corner);
  }
  return {placer.polygon(corners), named_properties("object", object)};
}

Feature feature_of(const RoadSurface& road, const GeoPlacer& placer) {
  std::vector<Vec3> outline;
  for (const Vec2 p : road.polygon) outline.push_back(flat(p));
  return {placer.polygon(outline), {{"part", "road"}}};
}

template <class Part>
void add_features(std::vector<Feature>& features, const std::vector<Part>& parts, const GeoPlacer& placer) {
  for (const Part& part : parts) features.push_back(feature_of(part, placer));
}

std::vector<Feature> features_of(const Scene& scene, const GeoPlacer& placer) {
  std::vector<Feature> features;
  add_features(features, scene.boundaries, placer);
  add_features(features, scene.openings, placer);
  add_features(features, scene.corners, placer);
  add_features(features, scene.junctions, placer);
  add_features(features, scene.objects, placer);
  if (scene.road && !scene.road->polygon.empty()) features.push_back(feature_of(*scene.road, placer));
  return features;
}

/// The frame's properties around the feature's own.
ordered_json feature_json(const Scene& scene, Feature feature) {
  ordered_json properties{{"frame", scene.frame}, {"stamp_ns", nullptr}, {"stamp_ns_text", nullptr}};
  if (scene.stamp_ns) {
    properties["stamp_ns"] = *scene.stamp_ns;
    properties["stamp_ns_text"] = std::to_string(*scene.stamp_ns);
  }
  properties["frame_id"] = scene.frame_id;
  properties.update(feature.properties);
  add_origin(properties, scene);
  return {
      {"type", "Feature"}, {"geometry", std::move(feature.geometry)}, {"properties", std::move(properties)}};
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
  for (Feature& feature : features_of(scene, GeoPlacer(T_local_sensor, origin_))) {
    text += std::exchange(has_feature_, true) ? ",\n" : "\n";
    text += text_of(feature_json(scene, std::move(feature)));
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
