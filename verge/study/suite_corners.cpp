// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include <cstddef>
#include <string>
#include <vector>

#include "verge/sim/scenario.hpp"
#include "verge/study/conditions.hpp"
#include "verge/study/corner_drives.hpp"
#include "verge/study/suite_list.hpp"

// One condition of paper 1's drives gets worse, all others stay: corners of 3 m at 30 km/h.

namespace verge::study {
namespace {

constexpr std::size_t kDrives = 25;  // 100 true corners a value
constexpr double kCar_m = 4.5;

/// Methods go on to be told the usual pitch.
void add_pitch(sim::DriveConfig& config, double value) { config.scenario.stand.pitch_deg += value; }

/// The vehicle against its course.
void set_yaw(sim::DriveConfig& config, double value) { config.scenario.course.crab_deg = value; }

/// Cars half on the sidewalk along this share of both kerbs.
void set_parked(sim::DriveConfig& config, double value) {
  if (value == 0.0) return;
  for (const sim::RoadSide side : {sim::RoadSide::kLeft, sim::RoadSide::kRight}) {
    config.scenario.roads[0].rows.push_back({.what = sim::Thing::kCar,
                                             .side = side,
                                             .from_m = 10.0,
                                             .to_m = 150.0,
                                             .beside_m = -0.8,
                                             .gap_m = kCar_m * (1.0 - value) / value,
                                             .length_m = kCar_m,
                                             .width_m = 1.6});
  }
}

}  // namespace

Suite corners_suite(const SuiteRequest& request) {
  Suite suite;
  suite.name = "corners";
  suite.title = "What conditions cost in corners";
  suite.about = corner_measures() + " Kerb returns of 3 m, 30 km/h; one condition changes, all others stay.";
  suite.judged = {.boundaries = false, .corners = true, .objects = false};
  const MadeDrives usual = corner_drives({}, kDrives, request);
  const auto add = [&](const std::string& condition, const std::vector<double>& values,
                       const Change& change) {
    add_condition(suite.cells, condition, values, usual, change);
  };
  add("range noise, m", {0.01, 0.03, 0.05, 0.08, 0.12}, set_noise);
  add("kerb height, m", {0.05, 0.08, 0.1, 0.12, 0.15, 0.2}, set_kerb);
  add("pitch off by, degrees", {-2.0, -1.0, 0.0, 1.0, 2.0}, add_pitch);
  add("yaw, degrees", {-10.0, -5.0, 0.0, 5.0, 10.0}, set_yaw);
  add_losses(suite.cells, {0.0, 0.1, 0.2, 0.3}, usual);
  add("kerbs lined with parked cars, share", {0.0, 0.25, 0.5, 0.75}, set_parked);
  suite.columns = corner_columns();
  return suite;
}

}  // namespace verge::study
