// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/eval/ground_plane.hpp"

#include <cmath>

#include "verge/scan/mount.hpp"

namespace verge::eval {

std::optional<GroundPrediction> ground_by_plane(const Cloud& cloud, const GroundPlaneConfig& config) {
  const MountEstimate estimate = estimate_mount(organise(cloud).scan);
  if (!estimate.plane_found) return std::nullopt;
  const LevelFrame frame(estimate.mount);
  GroundPrediction prediction;
  prediction.is_ground.reserve(cloud.x.size());
  prediction.height_m.reserve(cloud.x.size());
  for (std::size_t i = 0; i < cloud.x.size(); ++i) {
    const double height_m = frame.to_level({cloud.x[i], cloud.y[i], cloud.z[i]}).z;
    prediction.is_ground.push_back(std::abs(height_m) < config.tolerance_m);
    prediction.height_m.push_back(height_m);
  }
  return prediction;
}

}  // namespace verge::eval
