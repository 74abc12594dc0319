// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/emit/scene_properties.hpp"

#include <cassert>
#include <cmath>

namespace verge::emit {

using nlohmann::ordered_json;

namespace {

void add_where_known(ordered_json& properties, const char* name, const std::optional<double>& value) {
  if (value) properties[name] = rounded(*value);
}

}  // namespace

double rounded(double value) {
  assert(std::isfinite(value));
  constexpr double kPerUnit = 1e4;
  constexpr double kExact = 0x1p51;  // beyond it, rounding again could give another number
  const double scaled = std::round(value * kPerUnit);
  if (std::fabs(scaled) >= kExact) return value;
  return scaled / kPerUnit + 0.0;  // -0 + 0 = 0
}

ordered_json properties_of(const Boundary& boundary) {
  return {{"id", boundary.id},
          {"side", name_of(boundary.side)},
          {"model", name_of(boundary.model)},
          {"kind", name_of(boundary.kind)},
          {"confidence", rounded(boundary.confidence)}};
}

ordered_json properties_of(const Opening& opening) {
  return {{"width_m", rounded(opening.width_m)}, {"confidence", rounded(opening.confidence)}};
}

ordered_json properties_of(const Corner& corner) {
  ordered_json properties{{"id", corner.id}, {"side", name_of(corner.side)}};
  add_where_known(properties, "sigma_m", corner.sigma_m);
  add_where_known(properties, "distance_m", corner.distance_m);
  add_where_known(properties, "width_m", corner.width_m);
  add_where_known(properties, "exit_m", corner.exit_m);
  properties["confidence"] = rounded(corner.confidence);
  return properties;
}

ordered_json properties_of(const Junction& junction) {
  ordered_json properties{{"type", name_of(junction.type)}};
  ordered_json& branches = properties["branches_rad"] = ordered_json::array();
  for (const double branch_rad : junction.branches_rad) branches.push_back(rounded(branch_rad));
  properties["confidence"] = rounded(junction.confidence);
  return properties;
}

ordered_json properties_of(const Object& object) {
  ordered_json properties{{"id", object.id}, {"class", name_of(object.type)}};
  if (object.shape) properties["shape"] = name_of(*object.shape);
  properties["size"] = {rounded(object.size.length_m), rounded(object.size.width_m),
                        rounded(object.size.height_m)};
  properties["yaw_rad"] = rounded(object.yaw_rad);
  properties["confidence"] = rounded(object.confidence);
  return properties;
}

void add_point_properties(ordered_json& properties, const Boundary& boundary) {
  if (!boundary.height_m.empty()) {
    ordered_json& heights = properties["height_m"] = ordered_json::array();
    for (const double height_m : boundary.height_m) heights.push_back(rounded(height_m));
  }
  if (!boundary.state.empty()) {
    ordered_json& states = properties["state"] = ordered_json::array();
    for (const PointState state : boundary.state) states.push_back(name_of(state));
  }
}

void add_origin(ordered_json& properties, const Scene& scene) {
  if (!scene.method.empty()) properties["method"] = scene.method;
  if (!scene.version.empty()) properties["version"] = scene.version;
  if (!scene.config_hash.empty()) properties["config_hash"] = scene.config_hash;
}

std::string text_of(const ordered_json& value) {
  return value.dump(-1, ' ', false, ordered_json::error_handler_t::replace);
}

}  // namespace verge::emit
