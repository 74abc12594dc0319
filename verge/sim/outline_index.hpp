// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "verge/core/vec.hpp"
#include "verge/sim/outline.hpp"

namespace verge::sim {

/// The place of the outline nearest to a point.
struct NearestEdge {
  double outside_m = 0.0;  ///< Distance from it; negative on the drivable surface.
  std::size_t loop = 0;
  std::size_t vertex = 0;  ///< The stretch from this vertex to the next.
  double share = 0.0;      ///< How far along that stretch, 0..1.
  Vec2 foot;
};

/// Finds the nearest place of an outline by a grid of cells. Keeps a reference to the outline.
class OutlineIndex {
 public:
  /// The outline must have a loop, and must outlive the index.
  explicit OutlineIndex(const Outline& outline);

  [[nodiscard]] NearestEdge nearest(Vec2 p) const;

 private:
  struct Stretch {
    std::uint32_t loop = 0;
    std::uint32_t vertex = 0;
  };

  [[nodiscard]] std::size_t cell_of(std::int64_t column, std::int64_t row) const;
  void enter(Stretch stretch);
  void look(std::int64_t column, std::int64_t row, Vec2 p, double& least, NearestEdge& best) const;
  void settle_sign(Vec2 p, NearestEdge& best) const;
  [[nodiscard]] Vec2 vertex(std::size_t loop, std::size_t index) const;

  const Outline& outline_;
  Vec2 low_;
  std::int64_t columns_ = 1;
  std::int64_t rows_ = 1;
  std::vector<std::vector<Stretch>> cells_;
};

}  // namespace verge::sim
