// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <vector>

#include "verge/core/vec.hpp"
#include "verge/detect/gradient/gradient.hpp"
#include "verge/scan/quadrants.hpp"

namespace verge::detect::gradient {

/// A scan line in one of the regions a to d.
using Layer = QuadrantRing;

/// II-1 (1), with the gate of the settings.
[[nodiscard]] inline std::vector<LowRing> height_gate(const Scan& scan, const LevelFrame& frame,
                                                      const GradientConfig& config) {
  return verge::height_gate(
      scan, frame, {config.height_max_m, config.lateral_max_m, config.forward_max_m, config.range_min_m});
}

/// Distance from one return of a scan line to the next across the beams, in the plane and at the first one's
/// range: what they are apart in range does not count.
[[nodiscard]] inline double across_beams(Vec3 from, Vec3 to) {
  const double range = norm(to.xy());
  return range > 0.0 ? std::abs(cross(from.xy(), to.xy())) / range : 0.0;
}

}  // namespace verge::detect::gradient
