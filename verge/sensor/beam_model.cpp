// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/sensor/beam_model.hpp"

#include <cmath>
#include <numbers>

namespace verge::sensor {

std::int64_t revolution_ns(const BeamModel& model) { return std::llround(1e9 / model.rate_hz); }

double azimuth_step_rad(const BeamModel& model) {
  return 2.0 * std::numbers::pi * static_cast<double>(model.firing_period_ns) /
         static_cast<double>(revolution_ns(model));
}

}  // namespace verge::sensor
