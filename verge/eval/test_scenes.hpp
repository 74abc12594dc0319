// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "verge/model/scene.hpp"

// Small Scenes for the tests of the eval room.

namespace verge::testing {

/// A boundary along y = `y`, from x = from to x = to.
inline Boundary along_x(Side side, double y, double from, double to) {
  Boundary boundary;
  boundary.side = side;
  boundary.confidence = 1.0;
  boundary.points = {{from, y, -1.9}, {to, y, -1.9}};
  return boundary;
}

inline Scene scene_of(std::vector<Boundary> boundaries) {
  Scene scene;
  scene.frame = "000000";
  scene.boundaries = std::move(boundaries);
  return scene;
}

/// Both sides of a straight road.
inline Scene road(double left, double right, double from = -30.0, double to = 30.0) {
  return scene_of({along_x(Side::kLeft, left, from, to), along_x(Side::kRight, right, from, to)});
}

/// The scene seen in a mirror along the vehicle's path: left is right.
inline Scene mirrored(Scene scene) {
  for (Boundary& boundary : scene.boundaries) {
    for (Vec3& p : boundary.points) p.y = -p.y;
    if (boundary.side == Side::kLeft || boundary.side == Side::kRight)
      boundary.side = boundary.side == Side::kLeft ? Side::kRight : Side::kLeft;
  }
  return scene;
}

}  // namespace verge::testing
