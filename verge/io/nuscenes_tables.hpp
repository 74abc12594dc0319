// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string_view>
#include <vector>

#include "verge/core/log.hpp"
#include "verge/io/input.hpp"
#include "verge/io/scan_track.hpp"

namespace verge::io {

/// The time in a nuScenes file's name, "...__LIDAR_TOP__1532402927647951.pcd.bin" (microseconds since the
/// Unix epoch), in nanoseconds. None: another name.
[[nodiscard]] std::optional<std::int64_t> nuscenes_stamp_ns(const std::filesystem::path& file);

/// When and where the scans of a nuScenes folder (ROOT/samples/LIDAR_TOP or ROOT/sweeps/LIDAR_TOP) were
/// taken: times from the files' names, poses from the tables
/// ROOT/v1.0-*/{sample_data,ego_pose,calibrated_sensor}.json, read as streams, so that memory grows with the
/// scans asked for and not with the tables. The pose is of the frame x forward, y left that scans are turned
/// to; the world is the map's. Source: nuScenes' schema (nuscenes-devkit, docs/schema_nuscenes.md). Poses are
/// left out where one scan has none; the log says what was used, and what was not and why.
[[nodiscard]] ScanTrack find_nuscenes_track(const std::vector<std::filesystem::path>& files, const Log& log);

}  // namespace verge::io
