// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "verge/core/pose.hpp"
#include "verge/core/vec.hpp"
#include "verge/model/scene.hpp"

namespace verge::detect::road_width {

/// A corner at its place on the way.
struct FoundCorner {
  CornerSide side = CornerSide::kLeft;
  double at_m = 0.0;            ///< Of the entrance along the way.
  double lateral_m = 0.0;       ///< Of the kerb there, left of the vehicle's axis ...
  std::optional<Vec2> place{};  ///< ... or, better where it is known, in the world.
  double sigma_m = 0.0;         ///< Of the entrance's place.
  double radius_m = 0.0;        ///< Of the kerb's return; 0 where it is not known.
  double confidence = 1.0;
};

/// Corners that were found, until they are passed (A0.4: from the triangle relations).
class CornerTracks {
 public:
  void add(const FoundCorner& corner);
  /// The exit of the last corner of that side that has none yet: the road's edge is there again. The side
  /// road is as wide as the mouth but for the returns of that radius.
  void leave(CornerSide side, double exit_m, double radius_m);
  /// Without a way to go by, a corner lasts until it is left.
  void forget_left();
  /// Those at `way_m` whose exit is not passed, or, while it is not known, that began less than 30 m ago; in
  /// the level frame, whose pose is needed for places in the world. Of those entered, the distance is
  /// negative.
  [[nodiscard]] std::vector<Corner> at(double way_m, const std::optional<Pose>& T_world_level);

 private:
  struct Track {
    Corner corner;
    FoundCorner found;
    std::optional<double> exit_m{};  // along the way
  };

  std::vector<Track> tracks_;
  int next_id_ = 0;
};

}  // namespace verge::detect::road_width
