// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "verge/core/vec.hpp"
#include "verge/raster/grid.hpp"
#include "verge/raster/picture.hpp"

namespace verge::raster {

/// The points, metres, as squares of `size_px` >= 1 pixels a side, all of grey 255: "it is better to mark the
/// data with squares", so that the gaps between them close (paper 2, V-A; P2-12). Each square is the one
/// whose middle is nearest to its point. Points that are not finite or lie outside the grid (more than half a
/// cell from every pixel's centre) mark nothing; squares end at the picture's edge.
[[nodiscard]] Picture mark_squares(std::span<const Vec2> points, const Grid& grid, int size_px = 5);

}  // namespace verge::raster
