// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/raster/grid.hpp"

#include <cassert>
#include <cmath>

#include "verge/raster/picture.hpp"

namespace verge::raster {
namespace {

int pixels_over(double length_m, double cell_m) {
  constexpr double kRounding = 1e-9;  // 50 m / 0.1 m are 500 cells, whatever the last bit says
  const double cells = std::floor(length_m / cell_m + kRounding) + 1.0;
  assert(cells >= 1.0 && cells <= kMaxSide);
  return static_cast<int>(cells);
}

}  // namespace

Grid grid_over(Vec2 min_m, Vec2 max_m, double cell_m) {
  assert(cell_m > 0.0);
  return {.x_max_m = max_m.x,
          .y_max_m = max_m.y,
          .cell_m = cell_m,
          .rows = pixels_over(max_m.x - min_m.x, cell_m),
          .cols = pixels_over(max_m.y - min_m.y, cell_m)};
}

Vec2 to_pixels(const Grid& grid, Vec2 place_m) {
  return {(grid.y_max_m - place_m.y) / grid.cell_m, (grid.x_max_m - place_m.x) / grid.cell_m};
}

Vec2 to_metres(const Grid& grid, Vec2 place_px) {
  return {grid.x_max_m - grid.cell_m * place_px.y, grid.y_max_m - grid.cell_m * place_px.x};
}

}  // namespace verge::raster
