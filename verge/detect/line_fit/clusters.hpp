// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "verge/detect/line_fit/layer_points.hpp"
#include "verge/detect/line_fit/objects.hpp"

namespace verge::detect::line_fit {

/// Indices of the points of each thing that stands above the road, from left to right: the layers' points
/// parted at breakpoints, put together where layers see the same, and what is longer than
/// object_length_max_m parted where its outline goes in.
[[nodiscard]] std::vector<std::vector<std::size_t>> object_clusters(std::span<const LayerPoint> points,
                                                                    const ObjectsConfig& config);

}  // namespace verge::detect::line_fit
