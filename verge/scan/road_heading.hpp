// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "verge/scan/mount.hpp"

namespace verge {

struct Scan;

/// The direction in which the steps beside the road run (kerbs, walls, rows of parked cars), radians from +x
/// of the levelled frame `level` (a mount with forward_rad = 0), the nearest to +x; none where no direction
/// stands out. On a bend it is the direction of the longest straight stretch of step in view.
[[nodiscard]] std::optional<double> find_road_heading(const Scan& scan, const Mount& level,
                                                      const MountConfig& config);

}  // namespace verge
