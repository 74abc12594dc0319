// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/detect/road_width/corner_states.hpp"

#include <algorithm>

namespace verge::detect::road_width {
namespace {

constexpr std::size_t kLongestLag = 64;  // scans; the history keeps no more

}  // namespace

/// L_far(t - h), and of the first scan L_far(t).
double CornerStates::before_m(std::size_t lag) const {
  return first_m_[first_m_.size() - 1 - std::min(lag, first_m_.size() - 1)];
}

void CornerStates::look_for_corner(const LineLengths& lengths, std::size_t lag, CornerStep& done) {
  if (!candidate_) candidate_ = done.first_m > thresholds_.dd_m;  // Step 6
  if (!candidate_) return;
  if (done.second_m > thresholds_.ds_m) {  // Step 4
    ++k_;
    missed_ = 0;
  } else if (++missed_ > thresholds_.misses) {
    k_ = 0;
    missed_ = 0;
    candidate_ = false;
  }
  done.candidate = candidate_;
  done.k = k_;
  done.found = k_ > thresholds_.k;  // Step 5
  if (!done.found) return;
  straight_m_ = before_m(lag);  // Step 7
  found_way_m_ = lengths.way_m;
  in_corner_ = true;
  exit_seen_ = false;
  candidate_ = false;
  k_ = 0;
  missed_ = 0;
}

void CornerStates::look_for_exit(const LineLengths& lengths, std::size_t lag, CornerStep& done) {
  done.left = !exit_seen_ && lengths.first_m < before_m(lag) - thresholds_.ds_m;
  exit_seen_ = exit_seen_ || done.left;
  const bool is_straight = lengths.first_m < straight_m_ + thresholds_.ds_m;
  const bool has_rested = lengths.way_m == 0.0 || lengths.way_m - found_way_m_ >= thresholds_.rest_m;
  if (!is_straight || !has_rested) return;
  in_corner_ = false;
  done.left = done.left || !exit_seen_;
}

CornerStep CornerStates::step(const LineLengths& lengths, std::size_t lag) {
  lag = std::clamp<std::size_t>(lag, 1, kLongestLag);
  first_m_.push_back(lengths.first_m);  // Step 2: t grows by 1
  CornerStep done{.first_m = lengths.first_m - lengths.last_m, .second_m = lengths.first_m - before_m(lag)};
  if (in_corner_) look_for_exit(lengths, lag, done);
  if (!in_corner_) look_for_corner(lengths, lag, done);
  if (first_m_.size() > kLongestLag) first_m_.erase(first_m_.begin());
  return done;
}

}  // namespace verge::detect::road_width
