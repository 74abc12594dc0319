// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace verge::sensor {

/// One shot of a firing of a spinning scanner.
struct Laser {
  double elevation_rad = 0.0;  ///< Above the plane in which the head turns.
  std::int64_t time_ns = 0;    ///< From the start of a firing to this laser's shot.
  double azimuth_rad = 0.0;    ///< Clockwise, from the head's azimuth to the laser's.
  double up_m = 0.0;           ///< Height of the beam's origin.
  double left_m = 0.0;         ///< Beam's origin to the left of its own direction.
  std::size_t ring = 0;        ///< 0 is the lowest elevation.
};

/// The facts of a spinning scanner that decoder, encoder and simulator share. A firing is what repeats: one
/// shot of every laser (of an HDL-64E S1 three of each upper laser and one of each lower one). The head turns
/// on between the shots, so that each has its own azimuth.
struct BeamModel {
  std::string name;
  std::vector<Laser> lasers;          ///< The shots of a firing, in the order in which they are sent.
  std::int64_t firing_period_ns = 0;  ///< From one firing to the next.
  std::int64_t block_ns = 0;  ///< What is sent with one azimuth: a firing, a part of it, or several. It holds
                              ///< the shots that start within so many ns.
  double rate_hz = 10.0;      ///< Revolutions a second.
  bool clockwise = true;      ///< Sense of the rotation, seen from above.
  double range_min_m = 0.0;   ///< Nearer returns are not reported.
  double range_max_m = 0.0;   ///< Farther returns are not reported.
  double range_resolution_m = 0.0;  ///< Step of the ranges on the wire; 0 = as exact as a double.
};

/// Time of one revolution, rounded to a nanosecond.
[[nodiscard]] std::int64_t revolution_ns(const BeamModel& model);

/// Turn of the head between two firings, radians (positive whatever the sense of rotation).
[[nodiscard]] double azimuth_step_rad(const BeamModel& model);

}  // namespace verge::sensor
