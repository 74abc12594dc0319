// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "verge/sensor/ibeo/alasca_scan.hpp"
#include "verge/sensor/ibeo/lux.hpp"

namespace verge::sensor::ibeo {

/// The facts of an ALASCA XT that encoder and simulator share. Its messages hold coordinates, not angles: the
/// decoder needs none of these but the number of layers.
struct AlascaModel {
  std::string name;
  std::vector<double> layer_elevation_rad;  ///< By layer, 0 = the lowest; up is positive.
  double rate_hz = 0.0;                     ///< Scans a second.
  double range_min_m = 0.0;
  double range_max_m = 0.0;
  double step_rad = 0.0;  ///< Horizontal, between two pulses.
  double side_rad = 0.0;  ///< The scan runs from so far to the left to so far to the right.
};

/// ibeo ALASCA XT: four layers over 3.2 degrees, about 1.07 degrees apart, as paper 1 (Liu, Feng, Li, Zhang)
/// says in its Eq. 1 and its example at 20 Hz; placed evenly about the horizontal. Range and horizontal step
/// are the LUX's of paper 2, table I: paper 1 has none. It has no field of view either: 60 degrees to each
/// side are ours, wide enough for the road lines that it draws.
[[nodiscard]] AlascaModel alasca_xt();

/// The points of a scan, x forward, y left, z up, in the order of the message. Ring = layer, echo, flags =
/// AlascaStatus, pulse width as the sensor sends it. No times: the message says when the mirror was at angle
/// 0, on a clock of its own, but not how fast it turned. Points that the sensor calls invalid, points at the
/// origin (range 0), of a layer beyond 3 and of an echo beyond 3 are left out and counted.
[[nodiscard]] MessageCloud cloud_of(const AlascaScan& scan, const AlascaModel& model);

}  // namespace verge::sensor::ibeo
