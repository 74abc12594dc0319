// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/fit/banded.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace verge::fit {
namespace {

/// Subtracts multiples of the row `pivot` from those below it, so that its column is 0 there.
void eliminate_below(BandedMatrix& a, std::vector<Vec2>& b, std::size_t pivot) {
  const std::size_t end = std::min(a.size(), pivot + a.half_bandwidth() + 1);
  for (std::size_t row = pivot + 1; row < end; ++row) {
    const double factor = a.at(row, pivot) / a.at(pivot, pivot);
    for (std::size_t column = pivot; column < end; ++column)
      a.at(row, column) -= factor * a.at(pivot, column);
    b[row] = b[row] - factor * b[pivot];
  }
}

void substitute_back(const BandedMatrix& a, std::vector<Vec2>& b) {
  for (std::size_t row = a.size(); row-- > 0;) {
    const std::size_t end = std::min(a.size(), row + a.half_bandwidth() + 1);
    for (std::size_t column = row + 1; column < end; ++column)
      b[row] = b[row] - a.at(row, column) * b[column];
    b[row] = (1.0 / a.at(row, row)) * b[row];
  }
}

}  // namespace

BandedMatrix::BandedMatrix(std::size_t size, std::size_t half_bandwidth)
    : size_(size), half_bandwidth_(half_bandwidth), entries_(size * (2 * half_bandwidth + 1), 0.0) {}

std::optional<std::vector<Vec2>> solve(BandedMatrix a, std::vector<Vec2> b) {
  assert(b.size() == a.size());
  double greatest = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) greatest = std::max(greatest, std::abs(a.at(i, i)));
  constexpr double kSingular = 1e-13;
  for (std::size_t pivot = 0; pivot < a.size(); ++pivot) {
    if (!(std::abs(a.at(pivot, pivot)) > kSingular * greatest)) return std::nullopt;
    eliminate_below(a, b, pivot);
  }
  substitute_back(a, b);
  return b;
}

}  // namespace verge::fit
