// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/sensor/beam_model.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

namespace verge::sensor {

std::int64_t revolution_ns(const BeamModel& model) { return std::llround(1e9 / model.rate_hz); }

double azimuth_step_rad(const BeamModel& model) {
  return 2.0 * std::numbers::pi * static_cast<double>(model.firing_period_ns) /
         static_cast<double>(revolution_ns(model));
}

std::vector<std::size_t> rings_of(const BeamModel& model) {
  std::vector<std::size_t> by_elevation(model.lasers.size());
  std::iota(by_elevation.begin(), by_elevation.end(), 0U);
  std::stable_sort(by_elevation.begin(), by_elevation.end(), [&](std::size_t a, std::size_t b) {
    return model.lasers[a].elevation_rad < model.lasers[b].elevation_rad;
  });
  std::vector<std::size_t> rings(by_elevation.size());
  for (std::size_t ring = 0; ring < rings.size(); ++ring) rings[by_elevation[ring]] = ring;
  return rings;
}

}  // namespace verge::sensor
