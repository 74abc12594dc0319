// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>

#include "verge/core/vec.hpp"
#include "verge/detect/line_fit/edge_ends.hpp"
#include "verge/fit/l_shape.hpp"

namespace verge::detect::line_fit {

/// How far an object reaches in one direction, from the corner of its L away from the sensor: what was seen,
/// and by how much it may go on at either end.
struct Extent {
  double low_m = 0.0;
  double high_m = 0.0;
  EdgeEnd below{};
  EdgeEnd above{};

  [[nodiscard]] double seen_m() const { return high_m - low_m; }
  /// At the most.
  [[nodiscard]] double bound_m() const { return seen_m() + below.unseen_m + above.unseen_m; }
  [[nodiscard]] bool is_hidden() const { return below.is_hidden || above.is_hidden; }
  [[nodiscard]] bool is_cut() const { return below.is_cut || above.is_cut; }
};

/// An object's outline as far as it was seen.
struct Outline {
  Vec2 corner;                     ///< Of the L.
  std::array<Vec2, 2> onward{};    ///< Unit vectors along its two edges, away from the corner.
  std::array<Extent, 2> extent{};  ///< Along each of them.
  std::size_t returns = 0;
  double rough_m = 0.0;        ///< Root mean square of their distances from the L.
  std::array<bool, 2> face{};  ///< Whether the edge that runs along holds returns enough to be a face.
};

/// Faces, extents and what is beside them, from ranges of that deviation. Three returns on an edge make a
/// face; where neither edge has so many, the longer one is it.
[[nodiscard]] Outline outline_of(const fit::LShape& shape, const Beside& beside, double sigma_m);

/// The extent that an object of that usual size has: as near to it as what was seen allows, and what is not
/// seen added where it may be.
[[nodiscard]] Extent completed(const Extent& extent, double usual_m);

}  // namespace verge::detect::line_fit
