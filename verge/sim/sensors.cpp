// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/sim/sensors.hpp"

#include <array>
#include <stdexcept>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "verge/sensor/hdl32e.hpp"

namespace verge::sim {

std::span<const SensorEntry> sensors() {
  static constexpr std::array kSensors = {
      SensorEntry{"hdl32e", "Velodyne HDL-32E: 32 rings, 10 revolutions a second", sensor::hdl32e}};
  return kSensors;
}

sensor::BeamModel sensor_named(std::string_view name) {
  std::vector<std::string_view> names;
  for (const SensorEntry& entry : sensors()) {
    if (entry.name == name) return entry.make();
    names.push_back(entry.name);
  }
  throw std::invalid_argument(fmt::format("unknown sensor '{}' (known: {})", name, fmt::join(names, ", ")));
}

}  // namespace verge::sim
