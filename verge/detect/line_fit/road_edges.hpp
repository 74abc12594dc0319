// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "verge/detect/line_fit/edge_curve.hpp"
#include "verge/detect/line_fit/layer_points.hpp"
#include "verge/detect/line_fit/objects.hpp"
#include "verge/model/scene.hpp"
#include "verge/scan/mount.hpp"
#include "verge/scan/scan.hpp"

namespace verge::detect::line_fit {

struct RoadEdges {
  std::optional<Edge> left{};
  std::optional<Edge> right{};
};

/// Of the edges that run along the road the longest on either side of the vehicle's axis.
[[nodiscard]] RoadEdges road_edges(const std::vector<Edge>& edges, const LineFitConfig& config);

/// The edge as a boundary in the level frame, a vertex every half metre from its first to its last return,
/// at the height of the lowest returns: seen near to them, bridged in the gaps between (which P2 leaves
/// open). `points` are those that the edge was put through.
[[nodiscard]] Boundary boundary_of(const Edge& edge, Side side, std::span<const LayerPoint> points,
                                   const LineFitConfig& config);

/// All that was found, in the sensor's frame; the road's width every 5 m where both edges reach.
[[nodiscard]] Scene scene_of(const Scan& scan, std::span<const LayerPoint> points, const RoadEdges& edges,
                             std::span<const FoundObject> found, const LevelFrame& frame, const Mount& mount,
                             const LineFitConfig& config);

}  // namespace verge::detect::line_fit
