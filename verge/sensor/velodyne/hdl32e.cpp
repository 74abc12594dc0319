// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/sensor/velodyne/facts.hpp"

// Velodyne HDL-32E: 32 lasers from -30.67 to +10.67 degrees, fired lower and upper bank in turn.
//
// Sources: HDL-32E User's Manual and Programming Guide (63-9113), "Laser Firing Sequence" (order and angles),
// appendix B (2 mm a count, 0 = no return within 100 m), appendix E (1.152 us from laser to laser, 46.080 us
// from firing to firing). The angles have the digits of the calibration table that goes with the sensor's
// public drivers, which is within 0.010 degrees of the manual's print. Nearest range: drivers drop what is
// nearer than 0.9 m, where the housing and its window echo.
namespace verge::sensor::velodyne {
namespace {

/// Elevation of each laser in firing order, radians: steps of 4/3 degree.
constexpr std::array kElevationRad = {
    -0.5352925, -0.1628392, -0.5119051, -0.1396263, -0.4886922, -0.1164135, -0.4654793, -0.0930260,
    -0.4420919, -0.0698132, -0.4188790, -0.0466003, -0.3956661, -0.0232129, -0.3722787, 0.0000000,
    -0.3490659, 0.0232129,  -0.3258530, 0.0466003,  -0.3024656, 0.0698132,  -0.2792527, 0.0930260,
    -0.2560398, 0.1164135,  -0.2326524, 0.1396263,  -0.2094395, 0.1628392,  -0.1862266, 0.1862266};

constexpr std::int32_t kLaserToLaserNs = 1152;
constexpr std::int32_t kFiringToFiringNs = 46'080;

}  // namespace

Facts hdl32e_facts() {
  Facts facts{.model = Model::kHdl32e, .product = 0x21, .step_ns = kFiringToFiringNs};
  std::int32_t time_ns = 0;
  for (std::int32_t& slot : facts.slot_time_ns) {
    slot = time_ns;
    time_ns += kLaserToLaserNs;
  }
  for (const double elevation : kElevationRad) facts.calibration.push_back({.elevation_rad = elevation});
  return facts;
}

}  // namespace verge::sensor::velodyne
