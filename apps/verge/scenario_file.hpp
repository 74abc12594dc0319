// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

#include "verge/core/error.hpp"
#include "verge/sim/scenario.hpp"

namespace verge::app {

/// The scenario of a TOML file with [ground], [vehicle], [mount], [[vehicle.piece]], [[road]] and what stands
/// below each road: [[road.piece]], [[road.width]], [[road.height]], [[road.gap]], [[road.bay]],
/// [[road.island]], [[road.row]], [[road.thing]]. Fails with kUsage and the place of an unknown section or
/// key, or a value that does not fit; of what only the whole scenario shows, without a place.
[[nodiscard]] Expected<sim::Scenario> read_scenario(const std::filesystem::path& file);

/// The scenario as such a file.
[[nodiscard]] std::string to_toml(const sim::Scenario& scenario);

/// Every key of such a file: its section, default, unit, range and meaning.
[[nodiscard]] std::string scenario_keys();

}  // namespace verge::app
