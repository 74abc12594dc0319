// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>

#include "verge/detect/road_width/kerb_profile.hpp"

namespace verge::detect::road_width {

/// A stretch of one side where the road's edge lies beyond the straight kerb, along the way.
struct Opening {
  double inside_m = 0.0;  ///< The last place before it where the kerb was seen.
  double first_m = 0.0;   ///< The first place beyond the kerb, ...
  double last_m = 0.0;    ///< ... and the last one so far.
  double depth_m = 0.0;   ///< How far beyond in its latter half: the median.
};

/// The opening that the points (in order of the way) end in, before the kerb is seen again: more than
/// `widened_m` beyond the kerb. It takes two points in a row to begin or to end one. None where the points
/// end on the kerb, or begin beyond it.
[[nodiscard]] std::optional<Opening> last_opening(std::span<const KerbPoint> points, double widened_m);

/// Where, from `from_m` on, the kerb is seen again: between the last point beyond it and the first of two on
/// it. None where it is not.
[[nodiscard]] std::optional<double> end_of_opening(std::span<const KerbPoint> points, double from_m,
                                                   double widened_m);

}  // namespace verge::detect::road_width
