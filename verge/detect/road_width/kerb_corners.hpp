// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "verge/core/pose.hpp"
#include "verge/core/vec.hpp"
#include "verge/detect/road_width/corner_tracks.hpp"
#include "verge/detect/road_width/kerb_profile.hpp"
#include "verge/detect/road_width/kerb_return.hpp"
#include "verge/detect/road_width/opening.hpp"
#include "verge/detect/road_width/road_lines.hpp"
#include "verge/detect/road_width/road_width.hpp"

namespace verge::detect::road_width {

/// Where the vehicle is.
struct Whereabouts {
  Pose T_world_level{};
  Vec2 course{1.0, 0.0};  ///< Unit vector in which it goes, in the world.
  double way_m = 0.0;     ///< Since the first scan.
  double step_m = 0.0;    ///< d_v: since the scan before.
};

/// Corners from all four lines at once: where each of them ends, on each side, is put in its place along the
/// way, and together they show how the kerb runs. A corner begins where the kerb leaves its straight line,
/// if it does so in a wide curve, or stays away for longer than a driveway or a gap is wide and farther than
/// a parking bay is deep.
class KerbCorners {
 public:
  explicit KerbCorners(const RoadWidthConfig& config) : config_(config) {}

  /// The next scan's lines, first to last (one at least).
  void see(const std::vector<Road>& roads, const Whereabouts& here, CornerTracks& tracks);

 private:
  /// One side of the road.
  struct Watch {
    KerbProfile profile{};
    std::optional<StraightKerb> kerb{};      // as of the last scan
    double clear_from_m = 0.0;               // the kerb before says nothing of the one to come
    std::optional<FoundCorner> in_corner{};  // the entrance of a corner that was found and is not left yet
  };

  void add_sights(const std::vector<Road>& roads, const Whereabouts& here);
  void fit_kerb(Watch& watch, bool left, const Whereabouts& here, double to_m) const;
  void look_for_corner(Watch& watch, const Watch& other, bool left, const Whereabouts& here,
                       CornerTracks& tracks) const;
  void look_for_exit(Watch& watch, const Watch& other, const Whereabouts& here, CornerTracks& tracks) const;
  [[nodiscard]] double widened_m(const StraightKerb& kerb) const;
  [[nodiscard]] std::optional<KerbReturn> turn_at(const std::vector<KerbPoint>& points, double first_m,
                                                  const StraightKerb& kerb) const;
  [[nodiscard]] std::optional<FoundCorner> corner_of(const Opening& opening,
                                                     const std::vector<KerbPoint>& points,
                                                     const StraightKerb& kerb, const Whereabouts& here) const;

  RoadWidthConfig config_;
  std::array<Watch, 2> watches_;  // left, right
};

}  // namespace verge::detect::road_width
