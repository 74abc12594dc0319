// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

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

}  // namespace verge::detect::gradient
