// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/detect/road_width/corner_tracks.hpp"

#include <algorithm>

#include "verge/core/statistics.hpp"

namespace verge::detect::road_width {
namespace {

constexpr std::size_t kHistory =
    64;  // scans; also how long a road may be wider before it is the straight road

FirstLine medians_of(const std::deque<FirstLine>& history) {
  const auto median_of = [&](double FirstLine::*field) {
    std::vector<double> values;
    for (const FirstLine& line : history) values.push_back(line.*field);
    return median(values).value_or(0.0);
  };
  return {median_of(&FirstLine::length_m), median_of(&FirstLine::left_m), median_of(&FirstLine::right_m),
          median_of(&FirstLine::ahead_m)};
}

/// The sides on which the line has moved out by more than half of DS_thres; at least the one where more.
std::vector<CornerSide> sides_of(const FirstLine& line, const FirstLine& straight, double ds_thres_m) {
  const double left = line.left_m - straight.left_m;
  const double right = line.right_m - straight.right_m;
  if (std::min(left, right) > ds_thres_m / 2.0) return {CornerSide::kLeft, CornerSide::kRight};
  return {left > right ? CornerSide::kLeft : CornerSide::kRight};
}

}  // namespace

void Widening::see(const FirstLine& line, double way_m) {
  if (history_.empty()) straight_ = line;
  const bool widened = line.length_m > straight_.length_m + widened_m_;
  widened_scans_ = widened ? widened_scans_ + 1 : 0;
  if (!widened) began_m_.reset();
  if (widened && !began_m_) began_m_ = way_m;
  if (widened && widened_scans_ <= kHistory) return;
  history_.push_back(line);
  if (history_.size() > kHistory) history_.pop_front();
  straight_ = medians_of(history_);
}

void CornerTracks::add(const FirstLine& line, const FirstLine& straight, double began_m, double way_m,
                       double step_m, double ds_thres_m) {
  constexpr double kRefineError_m = 0.1;
  const double at_m = began_m + line.ahead_m;  // entrance_ahead = y_f - (s(n_d) - s(n_0)), A0.4
  if (at_m < way_m) return;                    // passed already
  for (const CornerSide side : sides_of(line, straight, ds_thres_m)) {
    Corner corner;
    corner.id = next_id_++;
    corner.side = side;
    corner.position.y = side == CornerSide::kLeft ? straight.left_m : -straight.right_m;
    corner.sigma_m = step_m / 2.0 + kRefineError_m;
    corner.confidence = 1.0;
    tracks_.push_back({corner, at_m});
  }
}

std::vector<Corner> CornerTracks::ahead(double way_m) {
  std::erase_if(tracks_, [&](const Track& track) { return track.at_m < way_m; });
  std::vector<Corner> corners;
  for (const Track& track : tracks_) {
    Corner corner = track.corner;
    corner.position.x = track.at_m - way_m;
    corner.distance_m = corner.position.x;
    corners.push_back(corner);
  }
  return corners;
}

}  // namespace verge::detect::road_width
