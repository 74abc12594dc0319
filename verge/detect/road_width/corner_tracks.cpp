// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/detect/road_width/corner_tracks.hpp"

#include <algorithm>
#include <ranges>

namespace verge::detect::road_width {
namespace {

constexpr double kLongest_m = 30.0;

}  // namespace

void CornerTracks::add(const FoundCorner& found) {
  Corner corner;
  corner.id = next_id_++;
  corner.side = found.side;
  corner.sigma_m = found.sigma_m;
  corner.confidence = found.confidence;
  tracks_.push_back({corner, found});
}

void CornerTracks::leave(CornerSide side, double exit_m, double radius_m) {
  for (Track& track : std::views::reverse(tracks_)) {
    if (track.corner.side != side || track.exit_m) continue;
    track.exit_m = std::max(exit_m, track.found.at_m);
    track.corner.width_m = std::max(0.0, *track.exit_m - track.found.at_m - 2.0 * radius_m);
    return;
  }
}

void CornerTracks::forget_left() {
  std::erase_if(tracks_, [](const Track& track) { return track.exit_m.has_value(); });
}

std::vector<Corner> CornerTracks::at(double way_m, const std::optional<Pose>& T_world_level) {
  std::erase_if(tracks_, [&](const Track& track) {
    return track.exit_m.value_or(track.found.at_m + kLongest_m) < way_m;
  });
  std::vector<Corner> corners;
  for (const Track& track : tracks_) {
    Corner corner = track.corner;
    corner.distance_m = track.found.at_m - way_m;
    corner.position = {*corner.distance_m, track.found.lateral_m};
    if (track.found.place && T_world_level) {
      const Vec2 place = *track.found.place;
      corner.position = (inverse(*T_world_level) * Vec3{place.x, place.y, T_world_level->translation.z}).xy();
    }
    if (track.exit_m) corner.exit_m = *track.exit_m - way_m;
    corners.push_back(corner);
  }
  return corners;
}

}  // namespace verge::detect::road_width
