// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "verge/io/file/decoded.hpp"
#include "verge/io/input.hpp"
#include "verge/scan/scan.hpp"

namespace verge::io {

/// PCD 0.5 to 0.7, ascii, binary and binary_compressed, fields of any order, type and COUNT. x, y, z are
/// needed; intensity, ring and time are taken where a field has one of their names (columns.hpp). VIEWPOINT
/// is not applied, as PCL's own readers do not: points stay in the frame that they are stored in. Fails with
/// kUnusable (line and column in the header and in ascii data, byte offset in binary data), kLimit, kDamaged
/// (no points).
[[nodiscard]] Expected<Decoded> read_pcd(Input& input);

/// The scan as binary PCD, in the input's order, atomically: the columns of point_table.hpp with absolute
/// times. A stamp without times is not kept. Everything else of the points comes back bit for bit.
[[nodiscard]] Expected<void> write_pcd(const std::filesystem::path& path, const Scan& scan);

}  // namespace verge::io
