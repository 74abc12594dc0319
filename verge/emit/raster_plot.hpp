// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>

#include "verge/core/error.hpp"
#include "verge/core/vec.hpp"
#include "verge/model/trace.hpp"

namespace verge::emit {

enum class RasterColours {
  kGrey,  ///< By their share of the greatest value: squares and edges (paper 2, Fig. 15b, c).
  kHeat,  ///< By the root of that share, so that what is far below the peaks shows too (Fig. 16a).
};

/// A raster of a trace as PNG, 1200 pixels wide, with its axes. Axes of one unit are drawn to one scale. A
/// pixel shows the greatest of the values that fall into it, so that small things stay visible; what is not
/// above 0 is black. `marks` are drawn as squares, by the axes' values: x along the rows. Those outside are
/// left out. Fails with kLimit where memory does not suffice.
[[nodiscard]] Expected<std::string> raster_png(const Trace::Raster& raster, RasterColours colours,
                                               std::span<const Vec2> marks = {});

}  // namespace verge::emit
