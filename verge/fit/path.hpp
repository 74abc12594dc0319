// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "verge/core/vec.hpp"

namespace verge::fit {

/// The points that `indices` name, in that order.
[[nodiscard]] std::vector<Vec2> gather(std::span<const Vec2> points, std::span<const std::size_t> indices);

/// The indices of the points in ascending order along `direction` (any length but 0), ties from right to left
/// of it, equal points by index. A curve that turns by more than 90 degrees from the direction comes out
/// folded. (A2.2-9)
[[nodiscard]] std::vector<std::size_t> order_along(std::span<const Vec2> points, Vec2 direction);

/// Key points closer than this to the one before are duplicates: parameters would stall on them. (A2.2-9)
inline constexpr double kDuplicateDistance = 0.01;

/// The indices of the points that are left when each that lies nearer than `least_m` to the last one kept is
/// dropped: |Q_k - Q_{k-1}| >= least_m holds for what is left. The first point is always kept.
[[nodiscard]] std::vector<std::size_t> drop_duplicates(std::span<const Vec2> points,
                                                       double least_m = kDuplicateDistance);

/// Arc length of the polyline at each of its points, metres, from 0 at the first.
[[nodiscard]] std::vector<double> arc_lengths(std::span<const Vec2> points);

/// Each point replaced by the mean of the points within window_m / 2 of it along the path. Near the ends the
/// window shrinks on both sides alike, so that a straight path is not pulled inwards; the ends stay.
[[nodiscard]] std::vector<Vec2> moving_mean(std::span<const Vec2> points, double window_m);

}  // namespace verge::fit
