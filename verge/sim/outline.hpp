// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "verge/core/vec.hpp"
#include "verge/sim/road.hpp"

namespace verge::sim {

/// How far a chord may depart from the true curve, metres.
inline constexpr double kChordErrorMax_m = 0.5e-3;

/// What a stretch of the outline is.
enum class Part : std::uint8_t {
  kEdge,    ///< An edge of a road.
  kReturn,  ///< The arc that joins the edges of two roads.
  kEnd,     ///< The end of a road that goes on outside the world: no boundary.
  kIsland,  ///< The edge of an island.
};

/// A vertex of the outline, and what the outline is from there to the next.
struct OutlineVertex {
  Vec2 position;
  double step_m = 0.0;  ///< Height of kerb or wall; 0 = none. It changes evenly to the next vertex.
  Edge edge = Edge::kKerb;
  Part part = Part::kEdge;
  std::size_t road = 0;  ///< Whose edge it is; of a return, the branch.
  RoadSide side = RoadSide::kLeft;
};

/// A closed line around a part of the drivable surface, which lies to its left: counter-clockwise around the
/// surface, clockwise around what stands in it.
struct OutlineLoop {
  std::vector<OutlineVertex> vertices;
  bool island = false;
};

/// Where a branch leaves its road.
struct Mouth {
  std::size_t branch = 0;
  std::size_t road = 0;
  RoadSide side = RoadSide::kRight;
  double begin_m = 0.0;  ///< Stations on the road where the two kerb returns meet its edge, begin first.
  double end_m = 0.0;
  Vec2 begin;
  Vec2 end;
  double begin_branch_m = 0.0;  ///< Stations on the branch where the same two returns meet its edges.
  double end_branch_m = 0.0;
  Vec2 begin_center;  ///< Centres of the returns.
  Vec2 end_center;
};

/// The outline of all that can be driven on.
struct Outline {
  std::vector<OutlineLoop> loops;
  std::vector<Mouth> mouths;  ///< One a branch, in the order of the roads.
};

/// Whether a part of the stretch of the road's edge, between two of its stations, lies in a branch's mouth.
[[nodiscard]] bool in_mouth(const Outline& outline, std::size_t road, RoadSide side, double from_m,
                            double to_m);

/// The outline of the roads: the edges of each (exact offsets of its centre line), joined by arcs at the
/// mouths, as polylines that no curve departs from by more than kChordErrorMax_m and no step is longer than
/// `step_m`. Throws std::invalid_argument where a kerb return does not fit, two mouths overlap, or an island
/// leaves its road.
[[nodiscard]] Outline make_outline(const std::vector<Road>& roads, double step_m);

}  // namespace verge::sim
