// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "verge/raster/picture.hpp"

namespace verge::raster {

/// "The HT": how many marked pixels of a picture lie on each line x cos(theta) + y sin(theta) = rho, x =
/// column and y = row (paper 2, III-A; P2-10, P2-11). A pixel counts at every angle in the bin of its rho,
/// rounded to the nearest whole pixel, halves up.
struct Accumulator {
  int angles = 0;  ///< Columns: theta = -90, -90 + 180 / angles, ... below 90 degrees, clockwise from +x.
  int reach = 0;  ///< D, pixels: rho is in -D .. D, D = ceil(hypot(rows - 1, cols - 1)); 0: an empty picture.
  std::vector<std::uint16_t> counts;  ///< angles x bins, angle by angle, from rho = -D on.

  [[nodiscard]] int bins() const { return 2 * reach + 1; }
  [[nodiscard]] double theta_rad(int angle) const;
  /// The bins of one angle, the first for rho = -D.
  [[nodiscard]] std::span<const std::uint16_t> column(int angle) const;
  [[nodiscard]] std::uint16_t at(int angle, int rho) const;
};

/// theta of a column when a half turn has so many, radians.
[[nodiscard]] double hough_theta_rad(int angle, int angles);

/// Makes accumulators. To be made once: it knows for each angle how blocks of pixels fall into bins, so that
/// a block costs about what a pixel does; the counts are those of pixel after pixel. Calls may run in
/// parallel.
class HoughTransform {
 public:
  /// `angles` >= 1 in a half turn; 180, the paper's, are one a degree.
  explicit HoughTransform(int angles = 180);

  [[nodiscard]] Accumulator operator()(const Picture& picture) const;

 private:
  struct Tables;
  std::shared_ptr<const Tables> tables_;
};

}  // namespace verge::raster
