// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "verge/core/vec.hpp"
#include "verge/scan/quadrants.hpp"

namespace verge::detect::gradient {

/// Where left and right of the road part, ahead or behind. The paper takes the vehicle's axis for it, which a
/// bend leaves: on a 6 m road of 40 m radius, beyond some 15 m both sides of the road lie on one side of it,
/// and of a scan line that starts outside the road the first rise outward is no boundary. This axis goes on
/// from scan line to scan line along the boundaries found so far.
class RoadAxis {
 public:
  explicit RoadAxis(bool front) : front_(front), heading_{front ? 1.0 : -1.0, 0.0} {}

  /// Goes on to the next scan line, from the innermost outward.
  void advance(const LowRing& ring);
  /// Where the last scan line crosses the axis, from the sensor.
  [[nodiscard]] Vec2 direction() const { return norm(place_) > 0.0 ? place_ : heading_; }
  /// What that scan line met first outward on either side.
  void follow(std::optional<Vec2> left, std::optional<Vec2> right);

 private:
  struct Side {
    std::vector<Vec2> feet;  ///< Of the boundary that runs on.
    bool runs_on = false;    ///< With the last scan line.
  };
  void extend(Side& side, std::optional<Vec2> foot);
  void turn();
  void keep_clear();

  bool front_;
  Vec2 place_{};
  Vec2 heading_;
  std::array<Side, 2> sides_;  ///< Left and right.
};

/// The returns of one scan line ahead or behind on both sides of a direction, left and right, each from it
/// outward.
[[nodiscard]] std::array<QuadrantRing, 2> parts_of(const LowRing& ring, bool front, Vec2 axis);

}  // namespace verge::detect::gradient
