// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/study/conditions.hpp"

#include <fmt/format.h>

namespace verge::study {

void set_noise(sim::DriveConfig& config, double value) { config.noise.range_sigma_m = value; }

void set_kerb(sim::DriveConfig& config, double value) { config.scenario.roads[0].kerb_m = value; }

void add_condition(std::vector<Cell>& cells, const std::string& condition, const std::vector<double>& values,
                   const MadeDrives& usual, const Change& change) {
  for (const double value : values) {
    MadeDrives drives = usual;
    drives.make = [make = usual.make, change, value](std::uint64_t drive) {
      sim::DriveConfig config = make(drive);
      change(config, value);
      return config;
    };
    cells.push_back({fmt::format("{} {:g}", condition, value), std::move(drives), condition, value});
  }
}

void add_losses(std::vector<Cell>& cells, const std::vector<double>& shares, const MadeDrives& usual) {
  for (const double share : shares) {
    MadeDrives drives = usual;
    drives.lost = share;
    add_condition(cells, "returns lost, share", {share}, drives, [](sim::DriveConfig&, double) {});
  }
}

}  // namespace verge::study
