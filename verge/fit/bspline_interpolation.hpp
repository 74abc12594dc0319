// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include "verge/core/vec.hpp"
#include "verge/fit/bspline.hpp"
#include "verge/fit/knots.hpp"

namespace verge::fit {

struct InterpolationOptions {
  std::size_t degree = 3;  ///< Lowered to the number of points less 1 where they are too few.
  Parameterization parameterization = Parameterization::kCentripetal;
  KnotPlacement knots = KnotPlacement::kAveraged;
};

/// The B-spline through the key points Q_0 .. Q_n in their order (paper 3, III-3 to III-5): parameters,
/// knots, and the inverse control points, those P_i for which sum_i P_i N_{i,p}(u_k) = Q_k (Piegl and Tiller,
/// algorithm A9.1). As many control points as key points. O(n p^2). None for fewer than 2 points, for a point
/// that equals the one before (see drop_duplicates), or, with uniform knots, where a knot span is left
/// without points so that no such curve is determined (Schoenberg-Whitney).
[[nodiscard]] std::optional<BSpline> interpolate(std::span<const Vec2> key_points,
                                                 const InterpolationOptions& options = {});

}  // namespace verge::fit
