// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace verge::raster {

/// Rows and columns of a picture are at most so many.
inline constexpr int kMaxSide = 8192;

/// A grey picture: 0 is background, everything else is marked (255: wholly). Rows go down, columns to the
/// right.
struct Picture {
  int rows = 0;
  int cols = 0;
  std::vector<std::uint8_t> grey;  ///< rows x cols, the uppermost row first.

  Picture() = default;
  /// All background. Both are in 0 .. kMaxSide.
  Picture(int rows_, int cols_)
      : rows(rows_), cols(cols_), grey(static_cast<std::size_t>(rows_) * static_cast<std::size_t>(cols_)) {}

  /// Where a pixel stands in `grey`.
  [[nodiscard]] std::size_t index(int row, int col) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(cols) + static_cast<std::size_t>(col);
  }
  [[nodiscard]] std::uint8_t& at(int row, int col) { return grey[index(row, col)]; }
  [[nodiscard]] std::uint8_t at(int row, int col) const { return grey[index(row, col)]; }
  /// False also outside the picture.
  [[nodiscard]] bool is_marked(int row, int col) const {
    return row >= 0 && row < rows && col >= 0 && col < cols && at(row, col) != 0;
  }

  friend bool operator==(const Picture&, const Picture&) = default;
};

}  // namespace verge::raster
