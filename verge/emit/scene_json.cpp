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
  if (scene.health) json["health"] = json_of(*scene.health);
  add_origin(json, scene);
  return text_of(json);
}

}  // namespace verge::emit
