// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string_view>

#include "verge/sensor/beam_model.hpp"

namespace verge::sim {

/// A sensor that can be simulated.
struct SensorEntry {
  std::string_view name;
  std::string_view about;  ///< One line.
  sensor::BeamModel (*make)();
};

[[nodiscard]] std::span<const SensorEntry> sensors();

/// The sensor of that name. Throws std::invalid_argument that lists the names.
[[nodiscard]] sensor::BeamModel sensor_named(std::string_view name);

}  // namespace verge::sim
