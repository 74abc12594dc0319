// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "verge/io/file/decoded.hpp"
#include "verge/io/input.hpp"

namespace verge::io {

/// KITTI and SemanticKITTI .bin: float32 x 4 little-endian a point: x forward, y left, z up, remission 0..1.
/// Neither rings nor times. Fails with kUnusable where the size is no multiple of 16 or the coordinates
/// cannot be metres (big-endian floats), kDamaged where it has no points.
[[nodiscard]] Expected<Decoded> read_kitti(Input& input);

}  // namespace verge::io
