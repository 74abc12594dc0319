// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string_view>
#include <vector>

#include "verge/core/log.hpp"
#include "verge/io/input.hpp"
#include "verge/io/scan_track.hpp"

namespace verge::io {

/// What stands beside the scans of a KITTI or SemanticKITTI drive; the world is the sensor's frame at the
/// first row. Looks for times.txt (seconds) or timestamps.txt (KITTI raw: date and time, taken as UTC), and
/// for poses.txt (left camera) with calib.txt (Tr: lidar to camera), in the folder of the scans and the one
/// above; for poses also poses/NN.txt beside sequences. T_world_sensor = Tr^-1 * pose * Tr. Without
/// them, the poses of a raw drive (kitti_oxts.hpp). Says in the log
/// what was found and what was not used and why.
[[nodiscard]] ScanTrack find_kitti_sequence(const std::filesystem::path& scans, const InputLimits& limits,
                                            const Log& log);

/// Rows of the sequence for files of these names: the number that the name is (000123.bin is row 123), or the
/// place in the list where names are no numbers but there are as many rows as files; empty: they do not fit.
[[nodiscard]] std::vector<std::size_t> kitti_rows(const std::vector<std::filesystem::path>& files,
                                                  std::size_t rows);

/// "2011-09-26 13:02:25.594360375" in UTC as nanoseconds since the Unix epoch. None: no time, or one before
/// 1970 or after 2261.
[[nodiscard]] std::optional<std::int64_t> parse_date_time(std::string_view text);

}  // namespace verge::io
