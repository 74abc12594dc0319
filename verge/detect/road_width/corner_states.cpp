// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/detect/road_width/corner_states.hpp"

#include <algorithm>

namespace verge::detect::road_width {
namespace {

constexpr std::size_t kLongestLag = 64;  // scans; the history keeps no more

}  // namespace

bool CornerStates::second_comparison(double first_m, std::size_t lag) const {
  const std::size_t back = std::min(lag, first_m_.size());
  return back > 0 && first_m - first_m_[first_m_.size() - back] > thresholds_.ds_m;
}

bool CornerStates::is_refractory(double first_m) {
  refractory_ = refractory_ && first_m >= straight_m_ + thresholds_.ds_m;
  return refractory_;
}

CornerStep CornerStates::step(const LineLengths& lengths, std::size_t lag) {
  lag = std::clamp<std::size_t>(lag, 1, kLongestLag);
  CornerStep done;
  if (!is_refractory(lengths.first_m)) {
    if (!candidate_) candidate_ = lengths.first_m - lengths.last_m > thresholds_.dd_m;  // Step 6
    if (candidate_) {
      if (second_comparison(lengths.first_m, lag)) {  // Step 4
        ++k_;
        missed_ = 0;
      } else if (++missed_ > thresholds_.misses) {
        k_ = 0;
        candidate_ = false;
      }
    }
    done = {.candidate = candidate_, .k = k_, .found = k_ > thresholds_.k};  // Step 5
  }
  if (done.found) {  // Step 7
    refractory_ = true;
    straight_m_ = first_m_[first_m_.size() - std::min(lag, first_m_.size())];
    candidate_ = false;
    k_ = 0;
  }
  if (!candidate_) missed_ = 0;
  first_m_.push_back(lengths.first_m);  // Step 2: t grows by 1
  if (first_m_.size() > kLongestLag) first_m_.erase(first_m_.begin());
  return done;
}

}  // namespace verge::detect::road_width
