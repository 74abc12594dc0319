// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "verge/core/vec.hpp"
#include "verge/scan/mount.hpp"

namespace verge {

struct Scan;

/// The road near the sensor as a plane z = offset + slope_x x + slope_y y in the sensor's frame, metres.
struct RoadPlane {
  double offset = 0.0;
  double slope_x = 0.0;
  double slope_y = 0.0;
  double inlier_share = 0.0;  ///< Share of the surface seen near the sensor that lies on the plane, 0..1.

  [[nodiscard]] double height_above(Vec3 p) const { return p.z - (offset + slope_x * p.x + slope_y * p.y); }
};

/// The plane that most of the lowest surface around the sensor lies on, nearer surface counting more. What
/// `hint` fixes of height, pitch and roll stays fixed. None where too little surface is seen.
[[nodiscard]] std::optional<RoadPlane> find_road_plane(const Scan& scan, const MountHint& hint,
                                                       const MountConfig& config);

/// The plane fitted again to the lane that the sensor is in, now that the road's heading is known (radians
/// from +x): a wide sidewalk beside a narrow road no longer draws it.
[[nodiscard]] RoadPlane refine_along_road(const Scan& scan, RoadPlane plane, double heading_rad,
                                          const MountHint& hint, const MountConfig& config);

}  // namespace verge
