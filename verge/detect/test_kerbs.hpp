// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>

#include "verge/scan/quadrants.hpp"
#include "verge/scan/scan.hpp"

// Closed-form scenes for tests: flat ground, straight kerbs along the road, no noise.
// Nothing is shared with the simulator.
namespace verge::detect::testing {

struct KerbScene {
  double sensor_height_m = 1.9;
  double lateral_m = 4.0;   ///< Of the kerbs, to both sides.
  double kerb_m = 0.12;     ///< Their height.
  double step_rad = 0.003;  ///< Between returns of a ring.
};

/// Where the ray of that elevation and azimuth (0 = along the road) first meets the scene, in the level
/// frame; none above the horizon.
[[nodiscard]] std::optional<Vec3> hit(const KerbScene& scene, double elevation_rad, double azimuth_rad);

/// One scan line in one region, from the road's axis outward.
[[nodiscard]] QuadrantRing kerb_layer(const KerbScene& scene, Quadrant region, double elevation_rad,
                                      std::size_t ring = 0);

/// All of a sensor with `rings` scan lines from -25 to -2 degrees, levelled, with its mount.
[[nodiscard]] Scan kerb_scan(const KerbScene& scene, std::size_t rings);

}  // namespace verge::detect::testing
