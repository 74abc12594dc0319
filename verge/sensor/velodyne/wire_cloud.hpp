// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "verge/scan/organise.hpp"
#include "verge/sensor/velodyne/facts.hpp"

// What a cloud of any origin needs before a sensor's encoder can take it.

namespace verge::sensor::velodyne {

/// Gives the rings the numbers that they have in the model (0 = lowest): each ring is of the laser whose cone
/// its points are nearest to, since a scan does not say which rings saw nothing. A point more than half a
/// degree off its cone gets -1: the sensor cannot have seen it there. A cloud without rings is left as it is.
void set_rings_of_model(Cloud& cloud, const Facts& facts, const Calibration& calibration);

/// Sets `time_s` to when the head of a sensor that turns evenly, from the rear on, looked at each point: the
/// nearest firing of its laser, whose number is the model's ring (set_rings_of_model()).
void set_times_by_azimuth(Cloud& cloud, const Facts& facts, const Calibration& calibration, double rate_hz);

}  // namespace verge::sensor::velodyne
