// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "verge/core/vec.hpp"
#include "verge/detect/road_width/road_line.hpp"
#include "verge/detect/road_width/road_width.hpp"
#include "verge/scan/mount.hpp"
#include "verge/scan/scan.hpp"

namespace verge::detect::road_width {

/// One of the four lines.
struct LayerLine {
  std::vector<PicturePoint> points{};  ///< From left to right.
  std::vector<Vec3> level{};           ///< The same in the level frame.
  std::size_t middle = 0;              ///< The point nearest to straight ahead.
  double tangent = 0.0;                ///< Of its angle from the vertical, straight ahead.
  double step_rad = 0.0;               ///< From point to point, typically.
};

/// The lines of the scan that meet the road ahead, first (farthest) to last (nearest), four at the most: its
/// layers where it has no more than four, else those rings whose points straight ahead are nearest to where
/// the four lines of the configuration would be. First echoes alone; `frame` is that of the mount.
[[nodiscard]] std::vector<LayerLine> four_lines(const Scan& scan, const LevelFrame& frame, const Mount& mount,
                                                const RoadWidthConfig& config);

}  // namespace verge::detect::road_width
