// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/raster/hough_peaks.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <span>
#include <tuple>

namespace verge::raster {
namespace {

struct Cell {
  int angle = 0;
  int rho = 0;
  int count = 0;
};

/// The order in which peaks are looked for: the greatest count first, then by angle, then by rho.
bool comes_after(const Cell& a, const Cell& b) {
  return std::tuple(-a.count, a.angle, a.rho) > std::tuple(-b.count, b.angle, b.rho);
}

/// The greatest count of each angle. A plain loop, which the compiler does eight counts at a time.
std::vector<int> greatest_of(const Accumulator& accumulator) {
  std::vector<int> greatest;
  for (int angle = 0; angle < accumulator.angles; ++angle) {
    std::uint16_t most = 0;
    for (const std::uint16_t count : accumulator.column(angle)) most = std::max(most, count);
    greatest.push_back(most);
  }
  return greatest;
}

/// The cells of at least that count, by angle, then by rho.
std::vector<Cell> cells_of(const Accumulator& accumulator, std::span<const int> greatest, int least) {
  std::vector<Cell> cells;
  for (int angle = 0; angle < accumulator.angles; ++angle) {
    if (greatest[static_cast<std::size_t>(angle)] < least) continue;
    int rho = -accumulator.reach;
    for (const int count : accumulator.column(angle)) {
      if (count >= least) cells.push_back({angle, rho, count});
      ++rho;
    }
  }
  return cells;
}

/// How far the neighbourhood reaches to either side, columns and bins.
struct Neighbourhood {
  int angles = 0;
  int bins = 0;
  int half_turn = 0;

  Neighbourhood(const Accumulator& accumulator, const PeakOptions& options)
      : angles(whole(options.theta_deg * accumulator.angles / 180.0)),
        bins(whole(options.rho_share * accumulator.bins())),
        half_turn(accumulator.angles) {}

  [[nodiscard]] bool holds(const Cell& a, const Cell& b) const {
    const int apart = std::abs(a.angle - b.angle);
    return (apart <= angles && std::abs(a.rho - b.rho) <= bins) ||
           (half_turn - apart <= angles && std::abs(a.rho + b.rho) <= bins);
  }

 private:
  static int whole(double reach) {
    constexpr double kRounding = 1e-9;
    return static_cast<int>(std::floor(reach + kRounding));
  }
};

}  // namespace

std::vector<HoughPeak> hough_peaks(const Accumulator& accumulator, const PeakOptions& options) {
  const std::vector<int> greatest = greatest_of(accumulator);
  const double share = greatest.empty() ? 0.0 : options.least_share * std::ranges::max(greatest);
  const int least = std::max(1, static_cast<int>(std::ceil(share)));
  const Neighbourhood near(accumulator, options);
  std::vector<Cell> cells = cells_of(accumulator, greatest, least);
  std::ranges::make_heap(cells, comes_after);  // few of the cells are ever looked at
  std::vector<Cell> found;
  while (!cells.empty() && static_cast<int>(found.size()) < options.most) {
    std::ranges::pop_heap(cells, comes_after);
    const Cell best = cells.back();
    cells.pop_back();
    if (std::ranges::none_of(found, [&](const Cell& cell) { return near.holds(cell, best); })) {
      found.push_back(best);
    }
  }
  std::vector<HoughPeak> peaks;
  for (const Cell& cell : found) peaks.push_back({accumulator.theta_rad(cell.angle), cell.rho, cell.count});
  return peaks;
}

}  // namespace verge::raster
