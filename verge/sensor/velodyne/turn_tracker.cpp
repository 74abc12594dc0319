// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/sensor/velodyne/turn_tracker.hpp"

#include <algorithm>
#include <cmath>

namespace verge::sensor::velodyne {
namespace {

constexpr std::int64_t kSilenceNs = 1'000'000'000;
constexpr double kFastestTurnPerNs = 40.0 * kTurn * 1e-9;
constexpr double kEncoderSlack = 36.0;  // hundredths of a degree

}  // namespace

TurnTracker::Move TurnTracker::step(std::int32_t azimuth, std::int64_t time_ns, double turn_per_ns) {
  const std::int32_t from_cut = (azimuth - cut_ + kTurn) % kTurn;
  const std::optional<Place> last = last_;
  if (!last || time_ns - last->time_ns > kSilenceNs) {
    last_ = {from_cut, time_ns};
    implausible_ = 0;
    return Move::kRestart;
  }
  // After a pause whose length was reckoned, the next stamp may be a little before.
  const auto elapsed_ns = static_cast<double>(std::max<std::int64_t>(0, time_ns - last->time_ns));
  const std::int32_t forward = (from_cut - last->from_cut + kTurn) % kTurn;
  // How many whole turns a gap hides: those that bring the advance nearest to what the rate says.
  const double missing = turn_per_ns * elapsed_ns - forward;
  const double hidden = missing < 0.5 * kTurn ? 0.0 : std::round(missing / kTurn);
  if (hidden == 0.0 && forward > kFastestTurnPerNs * elapsed_ns + kEncoderSlack) {
    if (++implausible_ < 3) return Move::kImplausible;
    last_.reset();
    return step(azimuth, time_ns, turn_per_ns);
  }
  implausible_ = 0;
  last_ = {from_cut, time_ns};
  const bool passed = hidden > 0.0 || from_cut < last->from_cut;
  return passed ? Move::kNextRevolution : Move::kSameRevolution;
}

}  // namespace verge::sensor::velodyne
