// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "verge/core/fields.hpp"
#include "verge/scan/mount.hpp"
#include "verge/sim/center_line.hpp"
#include "verge/sim/ground.hpp"
#include "verge/sim/road.hpp"
#include "verge/sim/weather.hpp"

namespace verge::sim {

/// How the vehicle goes: along a road at its lateral place, or, where it has pieces, along a line of its own
/// that begins there.
struct Course {
  std::int64_t road = 1;
  double at_m = 20.0;
  bool against = false;
  double lateral_m = 0.0;
  double crab_deg = 0.0;
  double speed_mps = 8.0;
  std::vector<Piece> pieces{};

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor&& visit) {
    visit(self.road, {"road", "1", 1, 1000, "number of the road that it is on", "ours"});
    visit(self.at_m, {"at_m", "m", 0.0, 1e4, "station at the start", "ours"});
    visit(self.against, {"against", "", 0, 0, "it goes against the road's direction", "ours"});
    visit(self.lateral_m, {"lateral_m", "m", -50.0, 50.0, "to the left of the road's centre line", "ours"});
    visit(self.crab_deg,
          {"crab_deg", "deg", -180.0, 180.0, "of its heading against its course, counter-clockwise", "ours"});
    visit(self.speed_mps, {"speed_mps", "m/s", 0.0, 60.0,
                           "speed along the road's centre line or its own line", "paper 1: 10, 30, 60 km/h"});
  }
};

/// How the sensor stands on the vehicle.
struct Stand {
  double height_m = 1.9;
  double pitch_deg = 0.57;
  double roll_deg = -0.46;
  double forward_deg = 0.0;
  double ahead_m = 0.0;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor&& visit) {
    visit(self.height_m, {"height_m", "m", 0.05, 20.0, "above the ground under the wheels",
                          "paper 1: 1, paper 2: 0.5, paper 3: on the roof"});
    visit(self.pitch_deg, {"pitch_deg", "deg", -85.0, 85.0, "turn of its front downward", "ours"});
    visit(self.roll_deg, {"roll_deg", "deg", -85.0, 85.0, "turn of its left side upward", "ours"});
    visit(self.forward_deg,
          {"forward_deg", "deg", -180.0, 180.0,
           "direction of the vehicle's front, from the sensor's +x counter-clockwise", "ours"});
    visit(self.ahead_m, {"ahead_m", "m", -10.0, 10.0, "before the middle of the wheels", "ours"});
  }
};

/// A situation: a piece of the world, and how a vehicle with a sensor goes through it.
struct Scenario {
  std::vector<RoadConfig> roads;
  GroundConfig ground;
  Course course;
  Stand stand;
  Weather weather;
};

/// The mount that says the same.
[[nodiscard]] Mount mount_of(const Stand& stand);

/// Gaps, bays, rows and branches of all roads change sides; center lines, items and islands stay.
void mirror(Scenario& scenario);

}  // namespace verge::sim
