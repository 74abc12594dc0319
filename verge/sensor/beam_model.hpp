// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace verge::sensor {

/// One laser of a spinning scanner.
struct Laser {
  double elevation_rad = 0.0;  ///< Above the plane in which the head turns.
  std::int64_t time_ns = 0;    ///< From the start of a firing to this laser's shot.
};

/// The facts of a spinning scanner that decoder, encoder and simulator share. A firing is one shot of every
/// laser; the head turns on between the shots, so that each laser has its own azimuth.
struct BeamModel {
  std::string name;
  std::vector<Laser> lasers;          ///< In firing order.
  std::int64_t firing_period_ns = 0;  ///< From one firing to the next.
  double rate_hz = 10.0;              ///< Revolutions a second.
  bool clockwise = true;              ///< Sense of the rotation, seen from above.
  double range_min_m = 0.0;           ///< Nearer returns are not reported.
  double range_max_m = 0.0;           ///< Farther returns are not reported.
  double range_resolution_m = 0.0;    ///< Step of the ranges on the wire; 0 = as exact as a double.
};

/// Time of one revolution, rounded to a nanosecond.
[[nodiscard]] std::int64_t revolution_ns(const BeamModel& model);

/// Turn of the head between two firings, radians (positive whatever the sense of rotation).
[[nodiscard]] double azimuth_step_rad(const BeamModel& model);

/// For each laser, in firing order, its ring: 0 is the lowest elevation. Equal elevations keep the firing
/// order.
[[nodiscard]] std::vector<std::size_t> rings_of(const BeamModel& model);

}  // namespace verge::sensor
