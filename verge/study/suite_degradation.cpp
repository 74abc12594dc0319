// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include <string>
#include <vector>

#include "verge/sim/ready.hpp"
#include "verge/sim/sensors.hpp"
#include "verge/study/conditions.hpp"
#include "verge/study/suite_list.hpp"

// One condition gets worse, all others stay: HDL-32E at 1.9 m, range noise 2 cm, kerbs of 12 cm, a street of
// 8 m between houses, straight and bent. Drive n takes the nth stretch of 40 m.

namespace verge::study {
namespace {

constexpr std::size_t kScans = 10;
constexpr std::uint64_t kStep = 5;        // scans of 0.8 m
constexpr std::uint64_t kStretches = 16;  // of the street
constexpr double kStretch_m = 40.0;
constexpr double kCar_m = 4.5;

sim::DriveConfig usual(std::uint64_t drive) {
  sim::DriveConfig config;
  config.scenario = sim::ready_scenario("street");
  config.scenario.course.at_m = 20.0 + kStretch_m * static_cast<double>((drive - 1) % kStretches);
  config.sensor = sim::sensor_named("hdl32e");
  config.noise.seed = drive;
  return config;
}

void set_pitch(sim::DriveConfig& config, double value) { config.scenario.stand.pitch_deg = value; }

/// Parked cars along this share of both kerbs.
void set_parked(sim::DriveConfig& config, double value) {
  if (value == 0.0) return;
  for (const sim::RoadSide side : {sim::RoadSide::kLeft, sim::RoadSide::kRight}) {
    config.scenario.roads[0].rows.push_back({.what = sim::Thing::kCar,
                                             .side = side,
                                             .beside_m = -0.25,
                                             .gap_m = kCar_m * (1.0 - value) / value,
                                             .length_m = kCar_m});
  }
}

/// An arc, to the left on odd drives and to the right on even ones.
void set_curvature(sim::DriveConfig& config, double value) {
  const double sign = config.noise.seed % 2 == 1 ? 1.0 : -1.0;
  sim::RoadConfig road;
  road.pieces = {{100.0, sign * value}};
  config.scenario.roads = {road};
  config.scenario.course.at_m = 30.0;
}

}  // namespace

Suite degradation_suite(const SuiteRequest& request) {
  Suite suite;
  suite.name = "degradation";
  suite.title = "What conditions cost";
  suite.about =
      "Boundaries within 20 m, right within 0.2 m, as one condition changes and all others stay as they "
      "usually are: "
      "HDL-32E at 1.9 m, range noise 2 cm, pitch 0.57 degrees, kerbs of 12 cm, a street of 8 m between "
      "houses.";
  const MadeDrives drives{.make = usual,
                          .drives = request.drives.value_or(4),
                          .scans = request.scans.value_or(kScans),
                          .step = kStep};
  const auto add = [&](const std::string& condition, const std::vector<double>& values,
                       const Change& change) {
    add_condition(suite.cells, condition, values, drives, change);
  };
  add("range noise, m", {0.01, 0.02, 0.03, 0.04, 0.05}, set_noise);
  add("kerb height, m", {0.0, 0.03, 0.05, 0.08, 0.1, 0.12, 0.15, 0.2}, set_kerb);
  add("pitch, degrees", {-2.0, -1.0, 0.0, 1.0, 2.0}, set_pitch);
  add("kerb lined with parked cars, share", {0.0, 0.1, 0.2, 0.3, 0.4}, set_parked);
  add_losses(suite.cells, {0.0, 0.1, 0.2, 0.3}, drives);
  add("curvature, 1/m", {0.002, 0.005, 0.01, 0.02, 0.033, 0.05}, set_curvature);
  suite.columns = {{"scans", "scans", 0},        {"precision", "precision"},
                   {"recall", "recall"},         {"f1", "F1"},
                   {"success", "success"},       {"lateral_p95_m", "95 % error m"},
                   {"occluded_share", "hidden"}, {"occluded_recall", "hidden found"}};
  return suite;
}

}  // namespace verge::study
