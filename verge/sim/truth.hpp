// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "verge/core/pose.hpp"
#include "verge/core/vec.hpp"
#include "verge/model/scene.hpp"
#include "verge/sim/road.hpp"

namespace verge::sim {

/// The feet of a road's kerbs in the world frame, worked out once for many scans.
struct CurbFeet {
  std::vector<Vec3> left;  ///< A vertex every 0.1 m of the centre line, and one at the end.
  std::vector<Vec3> right;
  double height_m = 0.0;  ///< Of the kerb; 0 = none.
};

[[nodiscard]] CurbFeet curb_feet(const Road& road);

/// What a perfect detector would say of the road from this pose: both boundaries at the foot of their kerbs
/// in the sensor frame, clipped to `radius_m` around the sensor in the plane. A boundary that leaves the
/// circle and comes back is given as two. Vertices run along the road, the last one foremost. Model: kLine
/// where the boundary inside the circle is straight, else kPolyline. States are left empty: the road's truth
/// does not know what hides it.
[[nodiscard]] Scene truth_scene(const CurbFeet& feet, const Pose& T_world_sensor, double radius_m);

}  // namespace verge::sim
