// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string_view>
#include <vector>

#include "verge/core/error.hpp"
#include "verge/io/source.hpp"

namespace verge::io {

/// Whether a comes before b where runs of digits count as numbers: 2.bin before 10.bin. A total order: names
/// of equal numbers (2.bin, 02.bin) stand in the order of their bytes.
[[nodiscard]] bool natural_less(std::string_view a, std::string_view b);

/// Files of a folder that may hold scans, in natural order.
struct ScanFiles {
  std::filesystem::path folder;  ///< Where they are: the folder asked for, or the data set's own below it.
  std::vector<std::filesystem::path> files;
};

/// The scans of a folder by the suffixes of their names (.bin, .pcd.bin, .pcd, .ply; .csv where there is
/// nothing else), of the forced format's suffix if there is one; other files are left alone. Where the folder
/// itself has none, that of velodyne/, velodyne_points/data/, LIDAR_TOP/ or samples/LIDAR_TOP/ that has some.
/// Fails with kCannotOpen, kUnusable (none; says what was looked for) and kUsage (files of two formats:
/// choose one).
[[nodiscard]] Expected<ScanFiles> find_scan_files(const std::filesystem::path& folder,
                                                  std::optional<Format> forced);

}  // namespace verge::io
