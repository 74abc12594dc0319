// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <string_view>

#include "verge/sim/lidar_model.hpp"

namespace verge::sim {

/// A sensor that can be simulated.
struct SensorEntry {
  std::string_view name;
  std::string_view about;  ///< One line.
  double usual_rate_hz = 10.0;
  std::span<const double> rates_hz{};  ///< All that it can turn at; of a pair, all between them where `even`.
  bool even = false;
  LidarModel (*make)(double rate_hz) = nullptr;
};

[[nodiscard]] std::span<const SensorEntry> sensors();

/// The sensor of that name, at its usual rate or at that one. Throws std::invalid_argument that lists the
/// names, or the rates.
[[nodiscard]] LidarModel sensor_named(std::string_view name, std::optional<double> rate_hz = std::nullopt);

}  // namespace verge::sim
