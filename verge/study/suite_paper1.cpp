// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "verge/sim/ready.hpp"
#include "verge/sim/sensors.hpp"
#include "verge/study/suite_list.hpp"

// Table 1 of paper 1: corners of three radii at three speeds. Each drive passes four side roads of 4 to 5 m,
// and what looks like one: driveways of 1 to 2.5 m, gaps of the kerb, gaps between parked cars. Drives of one
// cell differ in places, widths, sides, kerbs of 12 to 15 cm and noise.

namespace verge::study {
namespace {

constexpr double kRate_hz = 20.0;  // of the scanner, as the paper has it
constexpr double kWay_m = 385.0;   // of the ready scenario's 400 m

/// What the paper prints of a cell.
struct Row {
  double radius_m;
  double speed_kmh;
  double m1;
  double m2;
};

// "Large, medium, small curvature" is read as the radius of the kerb returns: 8, 3 and 0.5 m.
constexpr std::array kTable1 = {
    Row{0.5, 10.0, 0.8867, 0.1825}, Row{0.5, 30.0, 0.8902, 0.1492}, Row{0.5, 60.0, 0.8967, 0.0977},
    Row{3.0, 10.0, 0.8390, 0.1789}, Row{3.0, 30.0, 0.8378, 0.1531}, Row{3.0, 60.0, 0.8415, 0.1156},
    Row{8.0, 10.0, 0.7121, 0.1850}, Row{8.0, 30.0, 0.7351, 0.1538}, Row{8.0, 60.0, 0.7217, 0.1094}};

void mirror(sim::Scenario& scenario) {
  for (sim::RoadConfig& road : scenario.roads) {
    road.side = sim::opposite(road.side);
    for (sim::Gap& gap : road.gaps) gap.side = sim::opposite(gap.side);
    for (sim::Bay& bay : road.bays) bay.side = sim::opposite(bay.side);
    for (sim::Row& row : road.rows) row.side = sim::opposite(row.side);
  }
}

void vary(sim::Scenario& scenario, std::uint64_t drive) {
  std::uint64_t which = 0;
  const auto between = [&](double low, double high) { return drawn(drive, which++, low, high); };
  scenario.roads[0].kerb_m = between(0.12, 0.15);
  for (sim::Gap& gap : scenario.roads[0].gaps) {
    gap.at_m += between(-3.0, 3.0);
    gap.width_m = between(1.0, 2.5);
  }
  for (sim::Row& row : scenario.roads[0].rows) row.gap_m = between(1.0, 2.5);
  for (std::size_t i = 1; i < scenario.roads.size(); ++i) {
    sim::RoadConfig& road = scenario.roads[i];
    road.at_m += between(-3.0, 3.0);
    road.width_m = road.driveway ? between(1.0, 2.5) : between(4.0, 5.0);
  }
  if (between(0.0, 1.0) < 0.5) mirror(scenario);
}

sim::DriveConfig drive_in(const Row& row, std::uint64_t drive) {
  sim::DriveConfig config;
  config.scenario = sim::ready_scenario(fmt::format("paper1-r{:g}-v{:g}", row.radius_m, row.speed_kmh));
  vary(config.scenario, drive);
  config.sensor = sim::sensor_named("alasca_xt");
  config.noise.seed = drive;
  config.noise.range_sigma_m = 0.03;
  return config;
}

Cell cell_of(const Row& row, const SuiteRequest& request) {
  const auto scans = static_cast<std::size_t>(std::floor(kWay_m / (row.speed_kmh / 3.6) * kRate_hz));
  return {.name = fmt::format("{:g} m, {:g} km/h", row.radius_m, row.speed_kmh),
          .scans = MadeDrives{.make = [row](std::uint64_t drive) { return drive_in(row, drive); },
                              .drives = request.drives.value_or(2),
                              .scans = request.scans.value_or(scans)}};
}

}  // namespace

Suite paper1_suite(const SuiteRequest& request) {
  Suite suite;
  suite.name = "paper1";
  suite.title = "Paper 1: true and false corners";
  suite.about =
      "M1 is the share of true corners that were reported within 2 m while they were ahead, M2 the share of "
      "false corners "
      "(driveways, gaps of the kerb, gaps between parked cars) that were. ALASCA XT 1 m up, turned down by "
      "13.4 degrees, "
      "20 scans a second, range noise 3 cm. The paper prints no counts and drove other roads.";
  suite.judged = {.boundaries = false, .corners = true, .objects = false};
  for (const Row& row : kTable1) {
    suite.cells.push_back(cell_of(row, request));
    suite.printed.push_back({suite.cells.back().name, "paper 1, printed", {{"m1", row.m1}, {"m2", row.m2}}});
  }
  suite.columns = {{"true_corners", "true", 0},
                   {"detected", "detected", 0},
                   {"m1", "M1"},
                   {"false_presented", "false", 0},
                   {"false_reported", "reported", 0},
                   {"m2", "M2"},
                   {"false_reports_a_km", "false a km", 2},
                   {"latency_m", "latency m", 2},
                   {"position_error_p95_m", "95 % error m", 2}};
  return suite;
}

}  // namespace verge::study
