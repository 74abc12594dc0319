// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "verge/sensor/beam_model.hpp"

namespace verge::sensor {

/// Velodyne HDL-32E at 10 revolutions a second: 32 lasers from -30.67 to +10.67 degrees, fired lower and
/// upper bank in turn.
///
/// Sources: HDL-32E User's Manual and Programming Guide (63-9113), "Laser Firing Sequence" (order and
/// angles), appendix B (2 mm a count, 0 = no return within 100 m), appendix E (1.152 us from laser to
/// laser, 46.080 us from firing to firing). The angles have the digits of the calibration table that goes
/// with the sensor's public drivers, which is within 0.010 degrees of the manual's print. Nearest range:
/// drivers drop what is nearer than 0.9 m, where the housing and its window echo.
[[nodiscard]] BeamModel hdl32e();

}  // namespace verge::sensor
