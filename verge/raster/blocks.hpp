// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "verge/raster/picture.hpp"

namespace verge::raster {

/// Sides of the blocks that a picture is divided into, pixels.
inline constexpr std::array kBlockSides = {4, 2, 1};

/// A block's upper left pixel.
struct BlockCorner {
  std::int16_t col = 0;
  std::int16_t row = 0;
};

/// A picture's blocks by their sides, as kBlockSides has them.
using Blocks = std::array<std::vector<BlockCorner>, kBlockSides.size()>;

/// The picture's marked pixels, each in one block, blocks as large as they go from the upper left on. Blocks
/// that follow each other in a list lie apart where there are many.
[[nodiscard]] Blocks blocks_of(const Picture& picture);

}  // namespace verge::raster
