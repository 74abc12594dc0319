// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "verge/io/input.hpp"
#include "verge/io/source.hpp"

namespace verge::io {

/// The suffix that tells a scan's format, in lower case: ".pcd.bin", ".bin", ".pcd", ".ply", ".csv"; empty
/// for any other name.
[[nodiscard]] std::string scan_suffix(const std::filesystem::path& path);

/// The file's name without its suffix, whatever the suffix is.
[[nodiscard]] std::string frame_name(const std::filesystem::path& path);

/// The format of the input, by its content first (reliability B3: G5, G11, G12, K2), then its name. `bin`
/// says which of the two .bin formats its neighbours have; it decides where content and size do not. Fails
/// with kUnusable (empty, compressed, nothing fits; the message says what was tried) and kUsage (kitti and
/// nuscenes fit alike).
[[nodiscard]] Expected<Format> sniff(Input& input, std::optional<Format> bin = std::nullopt);

/// Whether a name promises another format than the content turned out to be.
[[nodiscard]] bool name_lies(const std::filesystem::path& path, Format format);

}  // namespace verge::io
