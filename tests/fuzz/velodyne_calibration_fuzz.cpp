// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "tests/fuzz/fuzz.hpp"
#include "verge/sensor/velodyne/calibration.hpp"

namespace verge::fuzz {

namespace velodyne = sensor::velodyne;

std::vector<std::string> seeds() {
  return {
      "lasers:\n- {laser_id: 0, vert_correction: 0.1, rot_correction: -1e-3}\n- {laser_id: 1, "
      "vert_correction: 0.2}\n",
      "# c\nlasers:\n- laser_id: 1\n  vert_correction: 0.1\n  two_pt_correction_available: true\n- laser_id: "
      "0\n"
      "num_lasers: 2\n",
      "lasers: [{laser_id: 0}, {laser_id: 1, vert_correction: 1}]", "lasers:\n- {\n", ""};
}

void check(Bytes input) {
  const auto calibration = velodyne::read_calibration(input, "fuzz.yaml", 2);
  if (!calibration) {
    require(!calibration.error().what.empty() && !calibration.error().where.empty());
    return;
  }
  require(calibration->size() == 2);
  for (const velodyne::LaserCorrection& laser : *calibration) {
    require(std::isfinite(laser.elevation_rad) && std::isfinite(laser.azimuth_rad) &&
            std::isfinite(laser.distance_m));
  }
}

}  // namespace verge::fuzz
