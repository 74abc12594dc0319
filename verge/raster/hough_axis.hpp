// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace verge::raster {

/// The perpendicular onto which the lines of one angle are told apart: rho = x cos(theta) + y sin(theta) with
/// x = column and y = row, pixels; y goes down, so a growing theta turns clockwise (paper 2, Eq. (1), III-A;
/// P2-10, P2-11). In whole steps of 2^-48, so that the bin of a pixel is the same however it is summed up,
/// and the one that real numbers give: steps sum to less than 2^-35 over the largest picture.
class HoughAxis {
 public:
  static constexpr int kBits = 48;

  explicit HoughAxis(double theta_rad);

  /// Steps by which rho grows from a pixel to its right and to its lower neighbour.
  [[nodiscard]] std::int64_t right() const { return right_; }
  [[nodiscard]] std::int64_t down() const { return down_; }

  /// rho + 1/2 in steps: its whole part is the nearest whole rho; halves go up.
  [[nodiscard]] std::int64_t steps(int col, int row) const {
    return col * right_ + row * down_ + (std::int64_t{1} << (kBits - 1));
  }
  /// The nearest whole rho: the pixel's bin. |col| and |row| are below kMaxSide.
  [[nodiscard]] int rho(int col, int row) const { return static_cast<int>(steps(col, row) >> kBits); }

 private:
  std::int64_t right_;
  std::int64_t down_;
};

}  // namespace verge::raster
