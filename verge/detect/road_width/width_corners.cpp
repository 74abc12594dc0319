// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/detect/road_width/width_corners.hpp"

#include <algorithm>
#include <cmath>

#include "verge/core/statistics.hpp"
#include "verge/detect/road_width/layer_geometry.hpp"

namespace verge::detect::road_width {
namespace {

/// Scans; also how long a road may be wider before it is the straight road.
constexpr std::size_t kHistory = 64;

/// Two lines by their place from the first one.
struct Pair {
  std::size_t farther;
  std::size_t nearer;
};
constexpr std::array kPairs = {Pair{0, 3}, Pair{0, 2}, Pair{0, 1}, Pair{1, 3}};

CornerThresholds thresholds_of(const RoadWidthConfig& config) {
  const LayerGeometry lines{.nearest_rad = config.nearest_rad, .span_rad = config.span_rad};
  const bool printed = config.is_printed();
  return {.ds_m = config.ds_thres_m,
          .dd_m = config.dd_thres_m,
          .k = static_cast<std::size_t>(config.k_thres),
          .misses = printed ? 0 : static_cast<std::size_t>(config.misses),
          .rest_m = printed ? 0.0 : lines.first_to_last_m()};
}

FirstLine first_line(const Road& first, double reach_m) {
  const std::vector<PicturePoint>& points = first.line.points;
  return {.length_m = length_m(first, reach_m),
          .left_m = std::min(reach_m, -points[first.road.left.edge].x),
          .right_m = std::min(reach_m, points[first.road.right.edge].x),
          .ahead_m = points[first.line.middle].y};
}

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

WidthCorners::WidthCorners(const RoadWidthConfig& config)
    : config_(config),
      pairs_(config.is_printed() || config.pairs == 0 ? 1 : kPairs.size(),
             CornerStates(thresholds_of(config))),
      widening_(config.widened_m) {}

/// h: in the paper's reading a number of scans, else a way, so that a slow vehicle looks farther back.
std::size_t WidthCorners::lag_of(std::optional<double> step_m) const {
  if (config_.is_printed() || !step_m) return static_cast<std::size_t>(config_.lag);
  constexpr double kMost = 20.0;
  const double least = static_cast<double>(config_.k_thres) + 2.0;
  if (*step_m <= 0.0) return static_cast<std::size_t>(kMost);
  return static_cast<std::size_t>(
      std::clamp(std::round(config_.lag_m / *step_m), least, std::max(least, kMost)));
}

std::size_t WidthCorners::pairs_in_corner() const {
  return static_cast<std::size_t>(
      std::count_if(pairs_.begin(), pairs_.end(), [](const CornerStates& pair) { return pair.in_corner(); }));
}

/// A0.4: entrance_ahead = y_f - (s(n_d) - s(n_0)).
void WidthCorners::add_corner(const FirstLine& first, double way_m, double step_m,
                              CornerTracks& tracks) const {
  constexpr double kRefineError_m = 0.1;
  const FirstLine& straight = widening_.straight();
  const double at_m = widening_.began_m().value_or(way_m) + first.ahead_m;
  for (const CornerSide side : sides_of(first, straight, config_.ds_thres_m)) {
    tracks.add({.side = side,
                .at_m = at_m,
                .lateral_m = side == CornerSide::kLeft ? straight.left_m : -straight.right_m,
                .sigma_m = step_m / 2.0 + kRefineError_m});
  }
}

WidthStep WidthCorners::see(const std::vector<Road>& roads, double way_m, std::optional<double> step_m,
                            CornerTracks& tracks) {
  const double reach = reach_m(roads, config_);
  const FirstLine first = first_line(roads.front(), reach);
  WidthStep done{.lag = lag_of(step_m)};
  for (std::size_t i = 0; i < pairs_.size(); ++i) {
    const auto [farther, nearer] = kPairs.at(i);
    const std::size_t last = roads.size() - 1;
    const LineLengths lengths{.first_m = length_m(roads[std::min(farther, last)], reach),
                              .last_m = length_m(roads[std::min(nearer, last)], reach),
                              .way_m = way_m};
    const CornerStep step = pairs_[i].step(lengths, done.lag);
    if (i == 0) done.step = step;
  }
  widening_.see(first, way_m);
  const std::size_t needed = std::max<std::size_t>(1, static_cast<std::size_t>(config_.pairs));
  const bool was_in_corner = in_corner_;
  const std::size_t in_corner = pairs_in_corner();
  in_corner_ = was_in_corner ? in_corner > 0 : in_corner >= std::min(needed, pairs_.size());
  if (in_corner_ && !was_in_corner) add_corner(first, way_m, step_m.value_or(0.0), tracks);
  if (done.step.left || (was_in_corner && !in_corner_)) {
    for (const CornerSide side : {CornerSide::kLeft, CornerSide::kRight})
      tracks.leave(side, way_m + first.ahead_m, 0.0);
  }
  return done;
}

}  // namespace verge::detect::road_width
