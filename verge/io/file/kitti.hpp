// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "verge/io/file/decoded.hpp"
#include "verge/io/input.hpp"
#include "verge/scan/scan.hpp"

namespace verge::io {

/// KITTI and SemanticKITTI .bin: float32 x 4 little-endian a point: x forward, y left, z up, remission 0..1.
/// Neither rings nor times. Fails with kUnusable where the size is no multiple of 16 or the coordinates
/// cannot be metres (big-endian floats), kDamaged where it has no points.
[[nodiscard]] Expected<Decoded> read_kitti(Input& input);

/// Indices of the scan's points in the order in which write_kitti() has them, since the format has no ring
/// numbers but an order: ring by ring from the top. Points keep the input's order where that is so already,
/// else they stand ring by ring, each by azimuth.
[[nodiscard]] std::vector<std::uint32_t> kitti_order(const Scan& scan);

/// The scan as KITTI's float32 rows x, y, z, intensity (0 where it has none), atomically.
[[nodiscard]] Expected<void> write_kitti(const std::filesystem::path& path, const Scan& scan);

}  // namespace verge::io
