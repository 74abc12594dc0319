// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/study/corner_drives.hpp"

#include <cmath>

#include <fmt/format.h>

#include "verge/sim/ready.hpp"
#include "verge/sim/sensors.hpp"
#include "verge/study/suite_list.hpp"

namespace verge::study {
namespace {

constexpr double kRate_hz = 20.0;  // of the scanner, as the paper has it
constexpr double kWay_m = 385.0;   // of the ready scenario's 400 m

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
  if (between(0.0, 1.0) < 0.5) sim::mirror(scenario);
}

sim::DriveConfig drive_past(const CornerKind& kind, std::uint64_t drive) {
  sim::DriveConfig config;
  config.scenario = sim::ready_scenario(fmt::format("paper1-r{:g}-v{:g}", kind.radius_m, kind.speed_kmh));
  vary(config.scenario, drive);
  config.sensor = sim::sensor_named(kind.coarse ? "alasca_xt-coarse" : "alasca_xt");
  config.noise.seed = drive;
  config.noise.range_sigma_m = 0.03;
  config.truth_lines = false;
  return config;
}

}  // namespace

MadeDrives corner_drives(const CornerKind& kind, std::size_t drives, const SuiteRequest& request) {
  const auto scans = static_cast<std::size_t>(std::floor(kWay_m / (kind.speed_kmh / 3.6) * kRate_hz));
  return {.make = [kind](std::uint64_t drive) { return drive_past(kind, drive); },
          .drives = request.drives.value_or(drives),
          .scans = request.scans.value_or(scans),
          .mount = sim::mount_of(drive_past(kind, 1).scenario.stand)};
}

std::vector<Column> corner_columns() {
  return {{"true_corners", "true", 0},
          {"detected", "detected", 0},
          {"m1", "M1"},
          {"false_presented", "false", 0},
          {"false_reported", "reported", 0},
          {"m2", "M2"},
          {"false_reports_a_km", "others a km", 2},
          {"late", "late", 0},
          {"ahead_m", "ahead m", 2},
          {"position_error_p95_m", "95 % error m", 2}};
}

std::string corner_measures() {
  return "M1 is the share of true corners that were reported within 2 m before they were left, late those of "
         "them that were reported when they had been reached, M2 the share of false corners (driveways, gaps "
         "of the kerb, gaps between parked cars) that were reported. ALASCA XT 1 m up, turned down by 13.4 "
         "degrees, 20 scans a second, range noise 3 cm.";
}

}  // namespace verge::study
