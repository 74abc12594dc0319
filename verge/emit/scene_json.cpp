// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/emit/scene_json.hpp"

#include "verge/emit/scene_properties.hpp"

namespace verge::emit {
namespace {

using nlohmann::ordered_json;

ordered_json json_of(const Boundary& boundary) {
  ordered_json json = properties_of(boundary);
  ordered_json& points = json["points"] = ordered_json::array();
  for (const Vec3 p : boundary.points) points.push_back({rounded(p.x), rounded(p.y), rounded(p.z)});
  add_point_properties(json, boundary);
  return json;
}

ordered_json pair_of(Vec2 p) { return {rounded(p.x), rounded(p.y)}; }

ordered_json json_of(const Opening& opening) {
  ordered_json json{{"ends", {pair_of(opening.ends[0]), pair_of(opening.ends[1])}}};
  json.update(properties_of(opening));
  return json;
}

ordered_json json_of(const Corner& corner) {
  ordered_json json = properties_of(corner);
  json["position"] = pair_of(corner.position);
  return json;
}

ordered_json json_of(const Junction& junction) {
  ordered_json json = properties_of(junction);
  json["center"] = pair_of(junction.center);
  return json;
}

ordered_json json_of(const Object& object) {
  ordered_json json = properties_of(object);
  json["center"] = {rounded(object.center.x), rounded(object.center.y), rounded(object.center.z)};
  return json;
}

ordered_json json_of(const RoadSurface& road) {
  ordered_json json = ordered_json::object();
  for (const RoadWidth at : road.width_m)
    json["width_m"].push_back({rounded(at.distance_m), rounded(at.width_m)});
  for (const Vec2 p : road.polygon) json["polygon"].push_back(pair_of(p));
  return json;
}

/// Left out where there is none.
template <class Part>
void add_parts(ordered_json& record, const char* name, const std::vector<Part>& parts) {
  for (const Part& part : parts) record[name].push_back(json_of(part));
}

ordered_json json_of(const Health& health) {
  ordered_json json{{"state", health.state}, {"completeness", rounded(health.completeness)}};
  ordered_json& unobserved = json["unobserved"] = ordered_json::array();
  for (const Sector s : health.unobserved) unobserved.push_back({rounded(s.from_rad), rounded(s.to_rad)});
  return json;
}

}  // namespace

std::string to_json_line(const Scene& scene) {
  ordered_json json{{"schema", 1}, {"frame", scene.frame}};
  json["stamp_ns"] = scene.stamp_ns ? ordered_json(*scene.stamp_ns) : ordered_json(nullptr);
  json["frame_id"] = scene.frame_id;
  ordered_json& boundaries = json["boundaries"] = ordered_json::array();
  for (const Boundary& boundary : scene.boundaries) boundaries.push_back(json_of(boundary));
  add_parts(json, "openings", scene.openings);
  add_parts(json, "corners", scene.corners);
  add_parts(json, "junctions", scene.junctions);
  add_parts(json, "objects", scene.objects);
  if (scene.road) json["road"] = json_of(*scene.road);
  if (scene.health) json["health"] = json_of(*scene.health);
  add_origin(json, scene);
  return text_of(json);
}

}  // namespace verge::emit
