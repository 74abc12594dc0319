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

/// Distance of two returns of a scan line across the beams, in the plane: what they are apart in range does
/// not count.
[[nodiscard]] inline double across_beams(Vec3 a, Vec3 b) {
  const double ranges = norm(a.xy()) + norm(b.xy());
  return ranges > 0.0 ? 2.0 * std::abs(cross(a.xy(), b.xy())) / ranges : 0.0;
}

}  // namespace verge::detect::gradient
