// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/detect/line_fit/street_scene.hpp"

#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>

#include "verge/core/angle.hpp"
#include "verge/scan/organise.hpp"

namespace verge::detect::line_fit::testing {
namespace {

constexpr double kReach_m = 60.0;

/// A ray in the level frame.
struct Ray {
  Vec3 from;
  Vec3 along;
};

/// How far along the ray it meets the panel.
double meets(const Ray& ray, const Panel& panel) {
  const Vec2 side = panel.to - panel.from;
  const Vec2 along = ray.along.xy();
  const double denominator = cross(along, side);
  const Vec2 to_panel = panel.from - ray.from.xy();
  const double t = cross(to_panel, side) / denominator;
  const double share = cross(to_panel, along) / denominator;
  const double z = ray.from.z + t * ray.along.z;
  const bool hits = t > 0.0 && share >= 0.0 && share <= 1.0 && z >= panel.bottom_m && z <= panel.top_m;
  return hits ? t : std::numeric_limits<double>::infinity();
}

/// And the ground: the road between the kerbs, what is as high as they beyond.
double meets_ground(const Ray& ray, const Street& street, double level_m, bool on_road) {
  const double t = (level_m - ray.from.z) / ray.along.z;
  const double y = ray.from.y + t * ray.along.y;
  const bool is_between = y < street.left_m && y > street.right_m;
  return t > 0.0 && is_between == on_road ? t : std::numeric_limits<double>::infinity();
}

std::optional<Vec3> hit(const Street& street, const Ray& ray) {
  double t = std::min(meets_ground(ray, street, 0.0, true), meets_ground(ray, street, street.kerb_m, false));
  for (const double y : {street.left_m, street.right_m})
    t = std::min(t, meets(ray, {{-100.0, y}, {100.0, y}, 0.0, street.kerb_m}));
  for (const Panel& panel : street.panels) t = std::min(t, meets(ray, panel));
  if (!(t < kReach_m)) return std::nullopt;
  return ray.from + t * ray.along;
}

}  // namespace

Scan scan_of(const Street& street) {
  const LevelFrame frame(kLuxMount);
  const Vec3 from = frame.to_level({});
  Cloud cloud;
  for (int layer = 0; layer < 4; ++layer) {
    const double elevation = deg_to_rad(-1.2 + 0.8 * layer);
    for (int i = 200; i >= -200; --i) {
      const double azimuth = deg_to_rad(0.25 * i);
      const Vec3 shot{std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth),
                      std::sin(elevation)};
      const auto place = hit(street, {from, frame.to_level(shot) - from});
      if (!place) continue;
      const Vec3 p = frame.to_sensor(*place);
      cloud.x.push_back(static_cast<float>(p.x));
      cloud.y.push_back(static_cast<float>(p.y));
      cloud.z.push_back(static_cast<float>(p.z));
      cloud.ring.push_back(layer);
    }
  }
  Scan scan = organise(std::move(cloud)).scan;
  scan.mount = kLuxMount;
  return scan;
}

std::vector<LayerPoint> points_of(const Street& street) {
  return layer_points(scan_of(street), LevelFrame(kLuxMount), kLuxMount, {});
}

}  // namespace verge::detect::line_fit::testing
