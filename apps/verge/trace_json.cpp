// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "apps/verge/trace_json.hpp"

#include <cmath>

#include <nlohmann/json.hpp>

namespace verge::app {
namespace {

using Json = nlohmann::ordered_json;

/// As the coordinates of boundaries are written; never -0.
double rounded(double value) { return std::round(value * 1e4) / 1e4 + 0.0; }

Json json_of(const std::vector<Vec3>& points) {
  Json array = Json::array();
  for (const Vec3& p : points) array.push_back({rounded(p.x), rounded(p.y), rounded(p.z)});
  return array;
}

Json json_of(const Trace::Axis& axis) {
  return {{"name", axis.name}, {"unit", axis.unit}, {"first", axis.first}, {"step", axis.step}};
}

Json json_of(const Trace::Raster& layer) {
  return {{"name", layer.name},    {"rows", layer.rows},    {"cols", layer.cols},
          {"x", json_of(layer.x)}, {"y", json_of(layer.y)}, {"values", layer.values}};
}

}  // namespace

std::string to_json(const Trace& trace) {
  Json points = Json::array();
  for (const Trace::Points& layer : trace.points) {
    Json json{{"name", layer.name}, {"points", json_of(layer.points)}};
    if (!layer.group.empty()) json["group"] = layer.group;
    points.push_back(std::move(json));
  }
  Json lines = Json::array();
  for (const Trace::Line& layer : trace.lines) {
    lines.push_back({{"name", layer.name}, {"points", json_of(layer.points)}});
  }
  Json values = Json::array();
  for (const Trace::Values& layer : trace.values) {
    values.push_back({{"name", layer.name}, {"values", layer.values}});
  }
  Json rasters = Json::array();
  for (const Trace::Raster& layer : trace.rasters) rasters.push_back(json_of(layer));
  const Json json{{"points", std::move(points)},
                  {"lines", std::move(lines)},
                  {"values", std::move(values)},
                  {"rasters", std::move(rasters)}};
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace verge::app
