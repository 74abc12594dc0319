// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "apps/verge/console.hpp"
#include "apps/verge/signals.hpp"
#include "verge/core/error.hpp"
#include "verge/io/source.hpp"
#include "verge/sim/drive.hpp"

namespace verge::app {

/// What `verge simulate` was asked for.
struct SimulateRequest {
  std::optional<std::string> scenario;
  std::filesystem::path folder;
  std::string sensor = "hdl32e";
  std::optional<double> rate_hz;
  std::optional<std::string> format;
  std::optional<std::size_t> scans;
  std::optional<std::uint64_t> seed;
  std::optional<double> speed_kmh;
  std::optional<double> noise_m;
  std::vector<std::string> set;
  bool skewed = false;
  std::optional<std::filesystem::path> plot;
  bool list = false;
  bool keys = false;
  bool dump = false;
  Console::Options console;
};

/// How the scans of a sensor are written: as `name` says ("idc" is the ibeo format), else as nuScenes does a
/// Velodyne's, and as its own recording what an ibeo sends. Fails with kUsage where there is no such format,
/// or it is the recording of another maker's sensor.
[[nodiscard]] Expected<io::Format> format_of(const std::optional<std::string>& name,
                                             const sim::LidarModel& sensor);

/// Writes that many scans of a drive, with the labels of their points, their truth, their poses and, where
/// asked for, their pictures, into the request's folder; a signal ends it after a scan. Fails with
/// kCannotWrite, also where the folder holds files already.
[[nodiscard]] Expected<void> write_drive(const SimulateRequest& request, const sim::Drive& drive,
                                         io::Format format, std::size_t scans, Console& console,
                                         const Signals& signals);

}  // namespace verge::app
