// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/raster/squares.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdint>

namespace verge::raster {
namespace {

constexpr std::uint8_t kMarked = 255;

/// False for what is not a number, too.
bool lies_in(const Grid& grid, Vec2 px) {
  return px.x > -0.5 && px.x <= grid.cols - 0.5 && px.y > -0.5 && px.y <= grid.rows - 0.5;
}

/// The first of the `size` whole numbers whose middle is nearest to `middle`.
int first_of(double middle, int size) { return static_cast<int>(std::ceil(middle - 0.5 * size)); }

void mark(Picture& picture, int row0, int col0, int size) {
  const int from = std::max(col0, 0);
  const int to = std::min(col0 + size, picture.cols);
  for (int row = std::max(row0, 0); row < std::min(row0 + size, picture.rows); ++row) {
    std::fill_n(&picture.at(row, from), to - from, kMarked);
  }
}

}  // namespace

Picture mark_squares(std::span<const Vec2> points, const Grid& grid, int size_px) {
  assert(size_px >= 1 && size_px <= kMaxSide);
  Picture picture(grid.rows, grid.cols);
  for (const Vec2 point : points) {
    const Vec2 px = to_pixels(grid, point);
    if (lies_in(grid, px)) mark(picture, first_of(px.y, size_px), first_of(px.x, size_px), size_px);
  }
  return picture;
}

}  // namespace verge::raster
