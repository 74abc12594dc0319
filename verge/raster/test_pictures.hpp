// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <initializer_list>
#include <random>
#include <string_view>

#include "verge/raster/picture.hpp"

namespace verge::raster::testing {

/// A picture drawn by hand: a row a string, '.' is background and everything else is marked.
[[nodiscard]] inline Picture drawn(std::initializer_list<std::string_view> rows) {
  Picture picture(static_cast<int>(rows.size()), static_cast<int>(rows.begin()->size()));
  int row = 0;
  for (const std::string_view line : rows) {
    for (int col = 0; col < picture.cols; ++col) {
      if (line[static_cast<std::size_t>(col)] != '.') picture.at(row, col) = 255;
    }
    ++row;
  }
  return picture;
}

/// Marks a rectangle of the picture.
inline void fill(Picture& picture, int row, int col, int height, int width) {
  for (int r = row; r < row + height; ++r) {
    for (int c = col; c < col + width; ++c) picture.at(r, c) = 255;
  }
}

/// A picture with that share of its pixels marked, each alone and as the corner of a square.
[[nodiscard]] inline Picture sown(int rows, int cols, double share, int side, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> drawn(0.0, 1.0);
  Picture picture(rows, cols);
  for (int row = 0; row < rows; ++row) {
    for (int col = 0; col < cols; ++col) {
      if (drawn(random) < share)
        fill(picture, row, col, std::min(side, rows - row), std::min(side, cols - col));
    }
  }
  return picture;
}

}  // namespace verge::raster::testing
