// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "verge/core/vec.hpp"

namespace verge::raster {

/// Which metres a bird's-eye picture covers: x forward is up, y left is to the left. A pixel stands for the
/// place of its centre: column = (y_max - y) / r and row = (x_max - x) / r with r = cell_m. (A1.5)
struct Grid {
  double x_max_m = 0.0;  ///< x of the uppermost row.
  double y_max_m = 0.0;  ///< y of the leftmost column.
  double cell_m = 0.1;   ///< r: a pixel's side, above 0.
  int rows = 0;          ///< 0 .. kMaxSide, as `cols`.
  int cols = 0;

  friend bool operator==(const Grid&, const Grid&) = default;
};

/// The grid whose pixels' centres reach from x_min to x_max and from y_min to y_max, or less than a cell
/// short of x_min and y_min. Needs finite numbers with min <= max, cell_m > 0, and sides that kMaxSide
/// allows.
[[nodiscard]] Grid grid_over(Vec2 min_m, Vec2 max_m, double cell_m = 0.1);

/// Where a place lies in the picture: x = column, y = row, pixels, whole in a pixel's centre; outside the
/// picture as well.
[[nodiscard]] Vec2 to_pixels(const Grid& grid, Vec2 place_m);
/// The inverse of to_pixels.
[[nodiscard]] Vec2 to_metres(const Grid& grid, Vec2 place_px);

}  // namespace verge::raster
