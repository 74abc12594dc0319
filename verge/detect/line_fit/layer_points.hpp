// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "verge/core/fields.hpp"
#include "verge/core/vec.hpp"
#include "verge/scan/mount.hpp"
#include "verge/scan/scan.hpp"

namespace verge::detect::line_fit {

/// Settings of layer_points.
struct LayerPointsConfig {
  double range_max_m = 50.0;
  double nearest_rad = 1.3962634015954636;  // 80 degrees
  double span_rad = 0.12740903539558607;    // 7.3 degrees
  double side_rad = 1.0471975511965976;     // 60 degrees

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor&& visit) {
    visit(self.range_max_m,
          {"range_max_m", "m", 1.0, 500.0, "returns farther away are dropped", "P2 Fig. 6: 50 m"});
    visit(self.nearest_rad,
          {"nearest_rad", "rad", 0.1, 1.55,
           "angle from the vertical of the lowest of four layers, where a denser sensor's rings stand in for "
           "them; as a LUX 0.5 m up sees the road from 10 m on",
           "ours"});
    visit(self.span_rad, {"span_rad", "rad", 0.001, 0.5, "from the lowest to the highest of them", "ours"});
    visit(self.side_rad, {"side_rad", "rad", 0.1, 1.5707963267948966,
                          "points are looked at so far to the left and to the right",
                          "P2 Table I: 100 degrees; value ours"});
  }
};

/// A return of one of four layers.
struct LayerPoint {
  Vec3 place;                ///< In the level frame: x forward, y left, z above the road.
  std::size_t layer = 0;     ///< 0 = the lowest.
  double azimuth_rad = 0.0;  ///< As the scan has it, but from the mount's forward direction.
  double range_m = 0.0;      ///< From the sensor.
  std::size_t index = 0;     ///< In the scan.
};

/// The returns of the scan's four layers (or of the rings that stand in for them, see rings_of_four_layers)
/// within the range gate, which drops all others (P2's rejected rows stay as points at the origin): the
/// lowest layer first, each from left to right. All echoes of a shot are kept (P2-27), next to each other.
/// `frame` is that of the mount.
[[nodiscard]] std::vector<LayerPoint> layer_points(const Scan& scan, const LevelFrame& frame,
                                                   const Mount& mount, const LayerPointsConfig& config);

/// Points [begin, end) of each layer, lowest first; layers without points are left out.
[[nodiscard]] std::vector<std::pair<std::size_t, std::size_t>> layers_of(std::span<const LayerPoint> points);

/// The points seen from above, in their order.
[[nodiscard]] std::vector<Vec2> places_of(std::span<const LayerPoint> points);

}  // namespace verge::detect::line_fit
