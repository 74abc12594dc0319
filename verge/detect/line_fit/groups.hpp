// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "verge/core/vec.hpp"
#include "verge/detect/line_fit/layer_points.hpp"
#include "verge/detect/line_fit/line_fit.hpp"
#include "verge/model/scene.hpp"

namespace verge::detect::line_fit {

/// Points that make one edge each, indices into the layer points; and the centroids, where they come from
/// k-means.
struct Groups {
  std::vector<std::vector<std::size_t>> points{};
  std::vector<Vec2> centroids{};
};

/// The points put into groups. `objects` (level frame) stand in front of kerbs. Groups are not empty.
[[nodiscard]] Groups groups_of(std::span<const LayerPoint> points, std::span<const Object> objects,
                               EdgeGrouping grouping, const LineFitConfig& config);

/// k-means of all points (P2 IV).
[[nodiscard]] Groups kmeans_groups(std::span<const LayerPoint> points, const LineFitConfig& config);

}  // namespace verge::detect::line_fit
