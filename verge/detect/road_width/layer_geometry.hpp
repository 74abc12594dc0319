// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <numbers>

#include "verge/detect/reading.hpp"
#include "verge/detect/road_width/road_line.hpp"

namespace verge::detect::road_width {

/// How a four-layer scanner looks at the road (P1 Fig. 1), with the paper's numbers. Angles are from the
/// vertical: RO is the scanner's height, F_i where the middle of layer i meets the ground. The paper's lines
/// are numbered from the nearest one; its "first" detecting line is the farthest, its "last" the nearest.
struct LayerGeometry {
  double height_m = 1.0;                                   ///< RO, "h" in P1's section on corners.
  double nearest_rad = 75.0 * std::numbers::pi / 180.0;    ///< Angle of F_1 R O, of the last layer.
  double span_rad = 3.2 * std::numbers::pi / 180.0;        ///< From the last layer to the first.
  double step_rad = 3.2 / 3.0 * std::numbers::pi / 180.0;  ///< From layer to layer: "about 1.07 degrees".

  /// Where line i (0 = nearest) meets flat ground, metres ahead of O.
  [[nodiscard]] double hit_m(int line) const;
  /// Where it meets it at an angle from straight ahead in the scanner's own plane, in the frame of Fig. 2.
  /// The scanner is turned down so that its plane lies between the middle layers, and each layer is a cone
  /// about its axis: nearly a plane, so that its line runs nearly straight across. (A level scanner draws
  /// circles.)
  [[nodiscard]] PicturePoint hit(int line, double azimuth_rad) const;
  /// Eq. (1): from line i to the next one, metres. As printed, the farther angle has the step twice.
  [[nodiscard]] double gap_m(int line, Reading reading) const;
  /// d_l: from the last to the first line on the ground, metres.
  [[nodiscard]] double first_to_last_m() const;
  /// Up to this speed (m/s) there is a scan with the first line in a corner and the last one before it:
  /// d_v = s / f is not more than d_l.
  [[nodiscard]] double guaranteed_speed(double scans_a_second) const;
  /// How far a vertical face of that height stretches along the road where line i climbs it, metres.
  [[nodiscard]] double face_length_m(int line, double face_height_m) const;
};

}  // namespace verge::detect::road_width
