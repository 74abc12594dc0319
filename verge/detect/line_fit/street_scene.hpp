// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "verge/core/vec.hpp"
#include "verge/detect/line_fit/layer_points.hpp"
#include "verge/scan/mount.hpp"
#include "verge/scan/scan.hpp"

// A closed-form street for the tests of this folder: flat, a kerb on either side, no noise. Nothing is shared
// with the simulator.
namespace verge::detect::line_fit::testing {

/// Something that stands on the street: a plane face, upright, at one x or along one y.
struct Panel {
  Vec2 from;
  Vec2 to;
  double bottom_m = 0.0;
  double top_m = 1.5;
};

struct Street {
  double left_m = 4.0;    ///< y of the left kerb; ...
  double right_m = -3.0;  ///< ... and of the right one.
  double kerb_m = 0.12;   ///< Height of both; 0: none.
  std::vector<Panel> panels{};
};

/// A LUX 0.5 m up and turned down by 1.5 degrees.
inline constexpr Mount kLuxMount{.height_m = 0.5, .pitch_rad = 0.026179938779914945};

/// What its four layers hit, every quarter of a degree from 50 degrees left to 50 right; nothing beyond 60 m.
[[nodiscard]] std::vector<LayerPoint> points_of(const Street& street);

/// The same as a scan, with its mount.
[[nodiscard]] Scan scan_of(const Street& street);

}  // namespace verge::detect::line_fit::testing
