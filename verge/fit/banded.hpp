// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cassert>
#include <cstddef>
#include <optional>
#include <vector>

#include "verge/core/vec.hpp"

namespace verge::fit {

/// A square matrix whose entries are 0 where |row - column| exceeds its half bandwidth.
class BandedMatrix {
 public:
  BandedMatrix(std::size_t size, std::size_t half_bandwidth);

  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] std::size_t half_bandwidth() const { return half_bandwidth_; }
  /// An entry within the band.
  [[nodiscard]] double& at(std::size_t row, std::size_t column) { return entries_[index(row, column)]; }
  [[nodiscard]] double at(std::size_t row, std::size_t column) const { return entries_[index(row, column)]; }

 private:
  [[nodiscard]] std::size_t index(std::size_t row, std::size_t column) const {
    assert(row < size_ && column < size_);
    assert(row <= column + half_bandwidth_ && column <= row + half_bandwidth_);
    return row * (2 * half_bandwidth_ + 1) + half_bandwidth_ + column - row;
  }

  std::size_t size_;
  std::size_t half_bandwidth_;
  std::vector<double> entries_;
};

/// X of A X = B, two right-hand sides at once (x and y), by elimination without pivoting: stable for the two
/// kinds of system that splines make, totally positive ones (interpolation) and positive definite ones (least
/// squares). None where A is singular to working precision. O(n h^2) for half bandwidth h.
[[nodiscard]] std::optional<std::vector<Vec2>> solve(BandedMatrix a, std::vector<Vec2> b);

}  // namespace verge::fit
