// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "verge/core/vec.hpp"
#include "verge/detect/gradient/gradient.hpp"
#include "verge/detect/gradient/regions.hpp"

namespace verge::detect::gradient {

/// The returns that stand high over the road, by direction: a step with such returns right above it is a
/// vehicle or a wall and no kerb.
class Obstacles {
 public:
  Obstacles(const std::vector<LowRing>& low, const GradientConfig& config);

  /// Whether a return higher than obstacle_m stands above or just behind the foot of a step, seen outward
  /// from the road's axis.
  [[nodiscard]] bool stand_above(Vec3 foot, Quadrant region) const;

 private:
  struct High {
    double direction_rad;
    double range_m;
  };
  std::vector<std::vector<High>> sectors_;  // by direction, one degree each
};

}  // namespace verge::detect::gradient
