// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "apps/verge/console.hpp"
#include "apps/verge/signals.hpp"
#include "verge/core/error.hpp"
#include "verge/sim/drive.hpp"

namespace verge::app {

/// What `verge simulate` was asked for.
struct SimulateRequest {
  std::optional<std::string> scenario;
  std::filesystem::path folder;
  std::string sensor = "hdl32e";
  std::optional<std::size_t> scans;
  std::optional<std::uint64_t> seed;
  std::optional<double> speed_kmh;
  double noise_m = 0.02;
  bool skewed = false;
  std::optional<std::filesystem::path> plot;
  bool list = false;
  bool keys = false;
  bool dump = false;
  Console::Options console;
};

/// Writes that many scans of a drive, with their labels, their truth and, where asked for, their pictures,
/// into the request's folder; a signal ends it after a scan. Fails with kCannotWrite, also where the folder
/// holds files already.
[[nodiscard]] Expected<void> write_drive(const SimulateRequest& request, const sim::Drive& drive,
                                         std::size_t scans, Console& console, const Signals& signals);

}  // namespace verge::app
