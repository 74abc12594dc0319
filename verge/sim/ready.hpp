// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <string_view>

#include "verge/sim/scenario.hpp"

namespace verge::sim {

/// A scenario that is there to be used.
struct ReadyScenario {
  std::string name;
  std::string about;  ///< One line.
  std::function<Scenario()> make;
};

/// All ready scenarios in the order in which they are listed.
[[nodiscard]] std::span<const ReadyScenario> ready_scenarios();

/// The ready scenario of that name. Throws std::invalid_argument that names the nearest one.
[[nodiscard]] Scenario ready_scenario(std::string_view name);

/// A road with side roads, bends, parked cars and people, drawn by the seed: 200 m or more, 3 to 14 m wide,
/// kerbs of 3 to 20 cm or none. The same seed gives the same scenario.
[[nodiscard]] Scenario random_scenario(std::uint64_t seed);

}  // namespace verge::sim
