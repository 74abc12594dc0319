// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "verge/core/vec.hpp"

namespace verge::fit {

struct Circle {
  Vec2 centre;
  double radius_m = 0.0;
};

/// The circle through three points: the perpendicular bisectors of ab and ac meet in its centre, and its
/// radius is the distance of any of them (paper 3, III-2). None where the points are collinear or two
/// coincide.
[[nodiscard]] std::optional<Circle> circle_through(Vec2 a, Vec2 b, Vec2 c);

/// Curvature k_i = 1 / rho_i of each point of a path, 1/m, without sign: rho_i is the radius of the circle
/// through points i-1, i, i+1 (paper 3, III-2), collinear points have 0. The two ends have no circle: 0.
[[nodiscard]] std::vector<double> curvature(std::span<const Vec2> points);

/// The key points of the fitting curve (paper 3, III-2): the indices, ascending, of both ends and of every
/// point between them with k_i >= [k] = k_avg, the mean curvature of the points between the ends. On a path
/// that is exactly straight every point qualifies. Beware: on noisy points these are the noisiest.
[[nodiscard]] std::vector<std::size_t> key_points(std::span<const double> curvature);

/// Curvature that follows the shape instead of the noise, 1/m (ours): the path is first smoothed by a moving
/// mean over `window_m` of arc length, and the circle of a point goes through it and the points `window_m`
/// before and after it, whose means share no point with its own. Points nearer than that to an end have no
/// circle: 0.
[[nodiscard]] std::vector<double> smoothed_curvature(std::span<const Vec2> points, double window_m);

/// Key points by smoothed_curvature (ours): where it is at least k_avg, not 0, and the greatest within
/// window_m / 2 to either side (of equals, the first). Both ends are added. `curvature`: smoothed_curvature
/// of the points over the same window. Indices into `points`, ascending.
[[nodiscard]] std::vector<std::size_t> smoothed_key_points(std::span<const Vec2> points,
                                                           std::span<const double> curvature,
                                                           double window_m);

}  // namespace verge::fit
