// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

#include "verge/core/vec.hpp"
#include "verge/sensor/velodyne/facts.hpp"

namespace verge::sensor::velodyne {

/// What a laser must have measured to give a point.
struct Measurement {
  std::uint16_t count = 0;  ///< Distance on the wire, counts of Facts::range_step_m, at least 1.
  double azimuth = 0.0;  ///< Of the head when the laser fired: hundredths of a degree, clockwise, [0, 36000).
};

/// The projector's inverse for one point of that laser (x forward, y left, z up, metres). None where the
/// point is not finite, or nearer or farther than the wire can say.
[[nodiscard]] std::optional<Measurement> unproject(const LaserCorrection& laser, double range_step_m,
                                                   const Vec3& point);

/// How far a point lies over the cone that the laser's beam turns on, as an angle seen from the beam's
/// origin, radians; negative below.
[[nodiscard]] double elevation_over(const LaserCorrection& laser, const Vec3& point);

}  // namespace verge::sensor::velodyne
