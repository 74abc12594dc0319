// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <cmath>

#include "verge/sim/ready.hpp"
#include "verge/sim/sensors.hpp"
#include "verge/study/suite_list.hpp"

namespace verge::study {
namespace {

/// Where a stretch of the loop ends, as way from the start of the drive.
struct Stretch {
  const char* name;
  double to_m;
};

constexpr double kScan_m = 0.8;  // 8 m/s, ten scans a second
constexpr std::uint64_t kStep = 5;
constexpr std::array kStretches = {
    Stretch{"parked cars, people, a side road", 85.0}, Stretch{"first bend", 125.0},
    Stretch{"trees, a hedge, a driveway", 185.0},      Stretch{"second bend", 226.0},
    Stretch{"a guard rail, a side road", 316.0},       Stretch{"the rest of the loop", 455.0}};

sim::DriveConfig drive_of(std::uint64_t drive) {
  sim::DriveConfig config;
  config.scenario = sim::ready_scenario("campus");
  config.sensor = sim::sensor_named("hdl32e");
  config.noise.seed = drive;
  return config;
}

std::uint64_t scan_at(double way_m) { return static_cast<std::uint64_t>(std::lround(way_m / kScan_m)); }

}  // namespace

Suite campus_suite(const SuiteRequest& request) {
  Suite suite;
  suite.name = "campus";
  suite.title = "A drive round the campus";
  suite.about =
      "Boundaries within 20 m, right within 0.2 m, on a loop of 460 m with side roads, parked and moving "
      "cars, people, "
      "trees and houses. HDL-32E at 1.9 m, range noise 2 cm.";
  double from_m = 0.0;
  for (const Stretch& stretch : kStretches) {
    const std::uint64_t first = scan_at(from_m);
    const std::size_t scans = (scan_at(stretch.to_m) - first) / kStep;
    suite.cells.push_back({.name = stretch.name,
                           .scans = MadeDrives{.make = drive_of,
                                               .drives = request.drives.value_or(1),
                                               .scans = request.scans.value_or(scans),
                                               .first_scan = first,
                                               .step = kStep}});
    from_m = stretch.to_m;
  }
  suite.columns = {{"scans", "scans", 0},
                   {"precision", "precision"},
                   {"recall", "recall"},
                   {"f1", "F1"},
                   {"success", "success"},
                   {"lateral_median_m", "median error m"},
                   {"lateral_p95_m", "95 % m"},
                   {"occluded_share", "hidden"},
                   {"occluded_recall", "hidden found"}};
  return suite;
}

}  // namespace verge::study
