// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "verge/io/file/decoded.hpp"
#include "verge/io/input.hpp"
#include "verge/scan/scan.hpp"

namespace verge::io {

/// nuScenes .pcd.bin: float32 x 5 little-endian a point: x RIGHT, y FORWARD, z up, intensity 0..255, ring
/// 0..127 with 0 the lowest; turned here to x forward, y left. A point whose ring is none of these is dropped
/// and counted. Fails with kUnusable where the size is no multiple of 20, the coordinates cannot be metres,
/// or fewer than half of the points have a ring; kDamaged where it has no points.
[[nodiscard]] Expected<Decoded> read_nuscenes(Input& input);

/// The scan as nuScenes stores it, in the input's order, atomically. Coordinates come back bit for bit; what
/// the format has no room for (times, labels) is left out.
[[nodiscard]] Expected<void> write_nuscenes(const std::filesystem::path& path, const Scan& scan);

}  // namespace verge::io
