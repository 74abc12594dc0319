// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "verge/core/vec.hpp"

namespace verge {

/// Length of a polyline in the plane, metres. Fewer than two points: 0.
[[nodiscard]] double length(std::span<const Vec2> line);

/// Points every `step` metres of arc length from the first point on, as the line's vertices would be visited;
/// the last point is kept only where the spacing meets it. One point is handed back as it is; `step` must be
/// positive.
[[nodiscard]] std::vector<Vec2> resample(std::span<const Vec2> line, double step);

/// Distance of `p` from the nearest point of the polyline, metres; infinity where the line has no point.
[[nodiscard]] double distance_to(std::span<const Vec2> line, Vec2 p);

}  // namespace verge
