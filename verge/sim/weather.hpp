// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace verge::sim {

/// What is between the sensor and the world, and on it. All of it is off by default.
struct Weather {
  double rain_mmph = 0.0;
  double rain_echoes = 0.01;
  double wet_road = 0.0;
  double dirt = 0.0;
  double dirt_from_deg = -180.0;
  double dirt_to_deg = 180.0;
  double bloom_mrad = 0.0;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor&& visit) {
    visit(self.rain_mmph,
          {"rain_mmph", "mm/h", 0.0, 150.0,
           "rain: weaker returns (1.076 x rain^0.67 dB/km) and echoes of drops", "ITU-R P.1814"});
    visit(self.rain_echoes,
          {"rain_echoes", "1", 0.0, 1.0,
           "share of shots in which a drop answers, at 10 mm/h; it grows with the rain", "ours"});
    visit(
        self.wet_road,
        {"wet_road", "1", 0.0, 1.0,
         "share of a road's surface that is a mirror of water: less comes back, and mirror images", "ours"});
    visit(self.dirt,
          {"dirt", "1", 0.0, 1.0, "share of the window that is dirty, in patches of 2 degrees", "ours"});
    visit(self.dirt_from_deg,
          {"dirt_from_deg", "deg", -180.0, 180.0,
           "right end of the dirty part, counter-clockwise from the sensor's +x", "ours"});
    visit(self.dirt_to_deg, {"dirt_to_deg", "deg", -180.0, 180.0, "left end of the dirty part", "ours"});
    visit(self.bloom_mrad, {"bloom_mrad", "mrad", 0.0, 50.0,
                            "how far beside a retro-reflector beams still see it; 0 = not", "ours"});
  }
};

}  // namespace verge::sim
