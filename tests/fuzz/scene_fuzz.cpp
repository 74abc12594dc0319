// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "tests/fuzz/fuzz.hpp"
#include "verge/emit/scene_json.hpp"

namespace verge::fuzz {
namespace {

bool is_finite(const Scene& scene) {
  for (const Boundary& boundary : scene.boundaries) {
    for (const Vec3& p : boundary.points) {
      if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z)) return false;
    }
    for (const double height : boundary.height_m) {
      if (!std::isfinite(height)) return false;
    }
  }
  return true;
}

}  // namespace

std::vector<std::string> seeds() {
  Scene scene;
  scene.frame = "000001";
  scene.stamp_ns = 1'700'000'000'123'456'789;
  scene.boundaries.push_back({.id = 7,
                              .side = Side::kLeft,
                              .points = {{0.0, 3.5, -1.8}, {5.0, 3.6, -1.8}},
                              .height_m = {0.12, 0.11},
                              .state = {PointState::kVisible, PointState::kBridged}});
  scene.health = Health{.state = "degraded", .completeness = 0.5, .unobserved = {{-1.0, 1.0}}};
  scene.method = "gradient";
  return {emit::to_json_line(scene),
          R"({"frame": "a", "points": [[1, 2], [3, 4, 5]]})",
          R"({"frame": "a", "boundaries": [{"points": [], "confidence": 2}]})",
          R"({"frame": "\ud800", "boundaries": null})",
          "[[[[[[[[1e999]]]]]]]]",
          "{"};
}

/// What can be read is written, read and written again byte for byte.
void check(Bytes input) {
  const std::string line(reinterpret_cast<const char*>(input.data()), input.size());
  const auto scene = bounded(input, [&] { return emit::parse_scene(line); });
  if (!scene) {
    require(!scene.error().what.empty() && !scene.error().where.empty());
    return;
  }
  require(is_finite(*scene));  // JSON has no other numbers
  const std::string written = emit::to_json_line(*scene);
  const auto again = emit::parse_scene(written);
  require(again.has_value() && emit::to_json_line(*again) == written);
}

}  // namespace verge::fuzz
