// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "verge/core/vec.hpp"
#include "verge/sim/ground.hpp"
#include "verge/sim/outline.hpp"
#include "verge/sim/outline_index.hpp"
#include "verge/sim/road.hpp"
#include "verge/sim/section.hpp"
#include "verge/sim/world.hpp"

namespace verge::sim {

/// The roads and all ground around them: what stands on it is not part of it. Heights and mesh come from one
/// outline, so that truth taken from the outline is exact of the mesh.
///
/// Beside the carriageway, at a distance d from its edge: a kerb's or wall's step; a sidewalk that rises
/// outward by the crown's slope; then ground that falls by 5 % to the plain, which lies 0.1 m below the
/// lowest edge. Grass falls by 4 % from the edge to the plain; a ditch lies behind a shoulder of 1 m. An open
/// end of a road falls as grass does.
class Land {
 public:
  /// Throws std::invalid_argument where a road makes no sense or the outline crosses itself.
  Land(const std::vector<RoadConfig>& roads, const GroundConfig& ground);
  Land(const Land&) = delete;
  Land& operator=(const Land&) = delete;
  ~Land() = default;

  [[nodiscard]] const std::vector<Road>& roads() const { return roads_; }
  [[nodiscard]] const Outline& outline() const { return outline_; }
  [[nodiscard]] const OutlineIndex& index() const { return index_; }
  [[nodiscard]] const Ground& ground() const { return ground_; }

  /// Height of the carriageway or of the ground beside it; on the edge itself the carriageway's.
  [[nodiscard]] double height(Vec2 p) const;
  [[nodiscard]] Surface surface(Vec2 p) const;

  /// The ground beside a place of the outline.
  [[nodiscard]] Section section(std::size_t loop, std::size_t vertex, double share = 0.0) const;

  /// A vertex of the outline at the height of the carriageway: the foot of the step.
  [[nodiscard]] Vec3 foot(std::size_t loop, std::size_t vertex) const;

  /// The ground as triangles, out to 150 m beyond the roads. Between the vertices, which lie on height(), it
  /// is flat; no curve of the outline departs from its chords by more than kChordErrorMax_m.
  [[nodiscard]] World mesh() const;

 private:
  std::vector<Road> roads_;
  Ground ground_;
  Outline outline_;
  OutlineIndex index_;
  std::vector<std::vector<Vec3>> feet_;           // of each vertex of each loop
  std::vector<std::vector<double>> below_crown_;  // likewise
  double plain_m_ = 0.0;                          // of the plain, below the land
};

}  // namespace verge::sim
