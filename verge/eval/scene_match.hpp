// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "verge/core/vec.hpp"
#include "verge/model/scene.hpp"

namespace verge::eval {

/// How the boundaries of two Scenes are laid side by side.
struct MatchConfig {
  double range_m = 200.0;  ///< Beyond it nothing is looked at.
  double step_m = 0.1;     ///< Along a boundary, from sample to sample.
  bool any_side = false;   ///< Left goes with right as well.
};

/// A place on a boundary, and what the other Scene has nearest to it among the boundaries of the same side
/// (see goes_with()). Plane of the sensor frame, metres.
struct MatchedSample {
  Vec2 place;
  double range_m = 0.0;  ///< From the sensor.
  PointState state =
      PointState::kVisible;  ///< Of the nearer vertex; visible where the boundary does not tell.
  double distance_m = 0.0;   ///< Infinity where the other has no such boundary.
  /// Distance with a sign: positive where the place lies farther out than the other boundary: left of it as
  /// its points run, or, where the other is a right boundary, right of it.
  double outward_m = 0.0;
  /// Between the two directions, the way along them not counting, in [-pi/2, pi/2]; none for single points.
  std::optional<double> heading_rad;
};

/// Both Scenes' samples, side by side (left, right, island, other).
struct SceneMatch {
  std::vector<MatchedSample> predicted;
  std::vector<MatchedSample> truth;
};

/// Distances are to the other's lines, not to their samples: a perfect line is right at every tolerance.
[[nodiscard]] SceneMatch match_boundaries(const Scene& prediction, const Scene& truth,
                                          const MatchConfig& config = {});

}  // namespace verge::eval
