// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/detect/test_kerbs.hpp"

#include <cmath>
#include <numbers>
#include <utility>

#include "verge/core/angle.hpp"
#include "verge/scan/organise.hpp"

namespace verge::detect::testing {

std::optional<Vec3> hit(const KerbScene& scene, double elevation_rad, double azimuth_rad) {
  const double fall = -std::tan(elevation_rad);  // metres down for each metre of ground range
  if (fall <= 0.0) return std::nullopt;
  const auto at = [&](double rho) {
    return Vec3{rho * std::cos(azimuth_rad), rho * std::sin(azimuth_rad), scene.sensor_height_m - fall * rho};
  };
  const double aside = std::abs(std::sin(azimuth_rad));
  const double on_road = scene.sensor_height_m / fall;
  if (on_road * aside < scene.lateral_m) return at(on_road);
  const double at_kerb = scene.lateral_m / aside;
  if (at(at_kerb).z < scene.kerb_m) return at(at_kerb);
  return at((scene.sensor_height_m - scene.kerb_m) / fall);
}

QuadrantRing kerb_layer(const KerbScene& scene, Quadrant region, double elevation_rad, std::size_t ring) {
  QuadrantRing layer{ring, region, elevation_rad, scene.step_rad, {}};
  const double start = is_front(region) ? 0.0 : std::numbers::pi;
  const int n = static_cast<int>(std::numbers::pi / 2 / scene.step_rad);
  for (int i = 0; i < n; ++i) {
    const double azimuth = start + outward_sign(region) * (i + 0.5) * scene.step_rad;
    if (const auto p = hit(scene, elevation_rad, azimuth)) layer.points.push_back(*p);
  }
  return layer;
}

Scan kerb_scan(const KerbScene& scene, std::size_t rings) {
  Cloud cloud;
  const int n = static_cast<int>(2.0 * std::numbers::pi / scene.step_rad);
  for (std::size_t ring = 0; ring < rings; ++ring) {
    const double share = rings > 1 ? static_cast<double>(ring) / static_cast<double>(rings - 1) : 0.0;
    const double elevation = deg_to_rad(-25.0 + 23.0 * share);
    for (int i = 0; i < n; ++i) {
      const auto p = hit(scene, elevation, -std::numbers::pi + (i + 0.5) * scene.step_rad);
      if (!p) continue;
      cloud.x.push_back(static_cast<float>(p->x));
      cloud.y.push_back(static_cast<float>(p->y));
      cloud.z.push_back(static_cast<float>(p->z - scene.sensor_height_m));
      cloud.ring.push_back(static_cast<std::int64_t>(ring));
    }
  }
  Scan scan = organise(std::move(cloud)).scan;
  scan.mount = Mount{scene.sensor_height_m, 0.0, 0.0, 0.0};
  return scan;
}

}  // namespace verge::detect::testing
