// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/sensor/hdl32e.hpp"

#include <array>

namespace verge::sensor {
namespace {

/// Elevation of each laser in firing order, radians: steps of 4/3 degree, the lower bank of 16 and the upper
/// bank of 16 in turn.
constexpr std::array kElevationRad = {
    -0.5352925, -0.1628392, -0.5119051, -0.1396263, -0.4886922, -0.1164135, -0.4654793, -0.0930260,
    -0.4420919, -0.0698132, -0.4188790, -0.0466003, -0.3956661, -0.0232129, -0.3722787, 0.0000000,
    -0.3490659, 0.0232129,  -0.3258530, 0.0466003,  -0.3024656, 0.0698132,  -0.2792527, 0.0930260,
    -0.2560398, 0.1164135,  -0.2326524, 0.1396263,  -0.2094395, 0.1628392,  -0.1862266, 0.1862266};

constexpr std::int64_t kLaserToLaserNs = 1152;
constexpr std::int64_t kFiringToFiringNs = 46'080;

}  // namespace

BeamModel hdl32e() {
  BeamModel model{.name = "hdl32e",
                  .lasers = {},
                  .firing_period_ns = kFiringToFiringNs,
                  .rate_hz = 10.0,
                  .clockwise = true,
                  .range_min_m = 0.9,
                  .range_max_m = 100.0,
                  .range_resolution_m = 0.002};
  std::int64_t time_ns = 0;
  for (const double elevation_rad : kElevationRad) {
    model.lasers.push_back({elevation_rad, time_ns});
    time_ns += kLaserToLaserNs;
  }
  return model;
}

}  // namespace verge::sensor
