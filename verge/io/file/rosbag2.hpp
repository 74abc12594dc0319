// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <memory>
#include <vector>

#include "verge/core/log.hpp"
#include "verge/io/file/bag.hpp"
#include "verge/io/input.hpp"
#include "verge/io/recording.hpp"

namespace verge::io {

/// The messages of a .db3 of rosbag2 (SQLite), in the order in which they were written, one row in memory at
/// a time. Messages that rosbag2 compressed one by one (zstd) are unpacked. No metadata.yaml is needed: the
/// file says all that we use.
///
/// Fails with kUnusable where the bytes are no SQLite database or lack the tables of rosbag2.
[[nodiscard]] Expected<std::unique_ptr<Bag>> open_db3_bag(Input input);

/// Warns where SQLite's write-ahead log stands beside the .db3 with something in it: a recorder that was
/// killed left messages there, which are not read.
void warn_of_wal(const std::filesystem::path& db3, const Log& log);

/// Its scans; fails as open_db3_bag() and open_bag() do.
[[nodiscard]] Expected<std::unique_ptr<Recording>> open_db3(Input input, const RecordingOptions& options);

/// The files (.db3 or .mcap, also with .zstd behind that) of a rosbag2 folder in the order in which they were
/// recorded, which is that of the numbers in their names; empty where there are none.
[[nodiscard]] std::vector<std::filesystem::path> find_rosbag2_files(const std::filesystem::path& folder);

/// The scans of a folder of rosbag2, with or without its metadata.yaml, one file after the other as one
/// recording. Fails with kUnusable where there is no .db3 or .mcap, as the first file that cannot be opened
/// where there are no messages, and as open_bag() does; else a file that cannot be opened (one that was
/// compressed as a whole among them) is an Error in its place.
[[nodiscard]] Expected<std::unique_ptr<Recording>> open_rosbag2_folder(const std::filesystem::path& folder,
                                                                       const InputLimits& limits,
                                                                       const RecordingOptions& options);

}  // namespace verge::io
