// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "verge/core/vec.hpp"
#include "verge/sim/road.hpp"
#include "verge/sim/world.hpp"

namespace verge::sim {

/// The ground beside an edge, square to it. Heights count from the land there; x of a Vec2 is the distance
/// from the edge, y the height.
struct Section {
  Edge edge = Edge::kKerb;
  bool is_end = false;  ///< An open end: no boundary.
  double step_m = 0.0;  ///< Height of kerb or wall.
  KerbFace face = KerbFace::kVertical;
  double sidewalk_m = 0.0;
  double slope = 0.0;    ///< Of the sidewalk, outward and up.
  double edge_m = 0.0;   ///< Height of the carriageway at the edge.
  double plain_m = 0.0;  ///< Height of the plain.
};

/// The face of the step from foot to top: offset from the edge and height above the foot; the foot alone
/// where there is no step.
[[nodiscard]] std::vector<Vec2> face_of(const Section& section);

/// From the top of the step outward, to where the plain begins.
[[nodiscard]] std::vector<Vec2> profile_of(const Section& section);

/// Height at a distance from the edge beyond the face's foot.
[[nodiscard]] double height_at(const Section& section, double outside_m);

/// What lies there.
[[nodiscard]] Surface surface_at(const Section& section, double outside_m);

}  // namespace verge::sim
