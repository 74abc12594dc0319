// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/sim/ready.hpp"
#include "verge/sim/sensors.hpp"
#include "verge/study/suite_list.hpp"

namespace verge::study {
namespace {

constexpr double kRate_hz = 12.5;
constexpr std::size_t kDrives = 200;
constexpr std::size_t kScans = 10;

/// Where a person is and walks, so many metres ahead of the vehicle's start.
sim::Item person(double at_m, double lateral_m, double speed_mps, double across_mps) {
  return {.what = sim::Thing::kPerson,
          .at_m = at_m,
          .lateral_m = lateral_m,
          .speed_mps = speed_mps,
          .across_mps = across_mps};
}

/// One crosses the road where the vehicle does not get, one walks along it beside the parked cars, one on the
/// sidewalk behind them.
void add_persons(std::uint64_t drive, sim::Scenario& scenario) {
  constexpr double kWalk_mps = 1.2;
  const double begin_m = scenario.course.at_m;
  std::vector<sim::Item>& items = scenario.roads[0].items;
  const auto way = [&](std::uint64_t which) {
    return drawn(drive, which, -1.0, 1.0) < 0.0 ? -kWalk_mps : kWalk_mps;
  };
  const double across_mps = way(10);
  items.push_back(person(begin_m + drawn(drive, 11, 20.0, 40.0), -drawn(drive, 18, 1.5, 2.5) * across_mps,
                         0.0, across_mps));
  items.push_back(person(begin_m + drawn(drive, 12, 8.0, 40.0), drawn(drive, 13, 1.2, 2.8), way(14), 0.0));
  items.push_back(person(begin_m + drawn(drive, 15, 8.0, 40.0), drawn(drive, 16, -7.5, -6.1), way(17), 0.0));
}

/// Each drive is another stretch of the street, at another place of the lane.
sim::DriveConfig parked_drive(std::uint64_t drive) {
  sim::DriveConfig config;
  config.scenario = sim::ready_scenario("paper2");
  config.scenario.course.at_m = drawn(drive, 0, 25.0, 120.0);
  config.scenario.course.lateral_m += drawn(drive, 1, -0.4, 0.4);
  config.scenario.roads[0].kerb_m = drawn(drive, 2, 0.1, 0.15);
  for (std::uint64_t i = 0; sim::Row & row : config.scenario.roads[0].rows)
    row.gap_m += drawn(drive, 3 + i++, -0.4, 0.8);
  add_persons(drive, config.scenario);
  config.sensor = sim::sensor_named("lux", kRate_hz);
  config.noise.seed = drive;
  config.noise.range_sigma_m = 0.03;
  config.truth_radius_m = 35.0;  // cars that reach into the range
  return config;
}

/// The same street without what hides its kerbs.
sim::DriveConfig clear_drive(std::uint64_t drive) {
  sim::DriveConfig config = parked_drive(drive);
  std::erase_if(config.scenario.roads[0].rows,
                [](const sim::Row& row) { return row.what == sim::Thing::kCar; });
  return config;
}

MadeDrives drives_of(sim::DriveConfig (*make)(std::uint64_t), const SuiteRequest& request) {
  return {.make = make,
          .drives = request.drives.value_or(kDrives),
          .scans = request.scans.value_or(kScans),
          .step = 4,
          .seen_edges = true,
          .mount = sim::mount_of(make(1).scenario.stand)};
}

}  // namespace

Suite paper2_suite(const SuiteRequest& request) {
  Suite suite;
  suite.name = "paper2";
  suite.title = "Paper 2: road edges and parked cars";
  suite.about =
      "Road edges within 30 m, right within 0.2 m, and objects. A two-lane road with people and cars parked "
      "on "
      "both sides, LUX 0.5 m up, turned down by 1.5 degrees, range noise 3 cm; methods are told the mount. "
      "An "
      "edge counts as visible where three returns show its face, an object where three returns hit it. The "
      "paper prints pictures and no figures of these.";
  suite.judged = {.boundaries = true, .corners = false, .objects = true};
  suite.evaluation.range_m = 30.0;
  suite.evaluation.ranges_m = {10.0, 20.0, 30.0, 40.0};
  suite.cells = {{.name = "parked cars on both sides", .scans = drives_of(parked_drive, request)},
                 {.name = "no parked cars", .scans = drives_of(clear_drive, request)}};
  suite.columns = {{"scans", "scans", 0},
                   {"precision", "precision"},
                   {"recall", "recall"},
                   {"lateral_p95_m", "95 % error m"},
                   {"heading_p95_deg", "edge deg", 2},
                   {"cars_true", "cars", 0},
                   {"two_faced_cars_true", "of two faces", 0},
                   {"cars_heading_p95_deg", "car deg", 2},
                   {"two_faced_cars_heading_p95_deg", "two-faced deg", 2},
                   {"two_faced_cars_iou", "IoU"},
                   {"two_faced_cars_iou_above_0.7", "IoU 0.7"},
                   {"car_f1", "car F1"},
                   {"person_f1", "person F1"}};
  return suite;
}

}  // namespace verge::study
