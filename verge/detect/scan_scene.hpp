// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <utility>

#include "verge/core/vec.hpp"
#include "verge/model/scene.hpp"
#include "verge/scan/mount.hpp"
#include "verge/scan/scan.hpp"

// What methods do alike when they say what they found in a scan.

namespace verge::detect {

/// A Scene of that scan, in which nothing was found yet.
[[nodiscard]] inline Scene scene_about(const Scan& scan) {
  Scene scene;
  scene.frame = scan.frame;
  scene.stamp_ns = scan.stamp_ns;
  scene.frame_id = scan.frame_id;
  return scene;
}

/// Adds a boundary that stands in the level frame, in the sensor's; numbered from 0 in the order of adding.
inline void add_boundary(Scene& scene, Boundary boundary, const LevelFrame& frame) {
  boundary.id = static_cast<int>(scene.boundaries.size());
  for (Vec3& p : boundary.points) p = frame.to_sensor(p);
  scene.boundaries.push_back(std::move(boundary));
}

}  // namespace verge::detect
