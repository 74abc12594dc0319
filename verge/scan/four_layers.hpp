// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "verge/scan/mount.hpp"
#include "verge/scan/scan.hpp"

namespace verge {

/// Where the lines of a four-layer scanner lie on the road ahead, as angles from the vertical below it.
struct FourLayers {
  double nearest_rad = 0.0;  ///< Of the lowest layer's line.
  double span_rad = 0.0;     ///< From there to the highest layer's.
  double side_rad = 0.0;     ///< It looks so far to the left and to the right.
};

/// The indices of the ring's points from left to right, as four-layer scanners measure them: from straight
/// behind over the left, `forward_rad` (the mount's) and the right back to straight behind.
[[nodiscard]] std::vector<std::size_t> from_left(const Scan& scan, std::size_t ring, double forward_rad);

/// Whether point i is a return, and of several echoes of one shot the first.
[[nodiscard]] inline bool is_first_echo(const Scan& scan, std::size_t i) {
  return (scan.echo.empty() || scan.echo[i] == 0) && scan.range[i] > 0.0F;
}

/// The rings that are the scanner's four layers or stand in for them, lowest first: all where there are no
/// more than four; of a denser sensor those whose first echo straight ahead lies on the road nearest to where
/// the line of a layer would be, and fewer than four where fewer meet the road. `frame` is that of the mount;
/// a mount without height gives a denser sensor none.
[[nodiscard]] std::vector<std::size_t> rings_of_four_layers(const Scan& scan, const LevelFrame& frame,
                                                            const Mount& mount, const FourLayers& layers);

}  // namespace verge
