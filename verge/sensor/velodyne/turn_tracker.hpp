// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

#include "verge/sensor/velodyne/facts.hpp"

namespace verge::sensor::velodyne {

/// Follows the head around and says where a revolution ends: where the azimuth passes the cut, counted with
/// the turns that a loss of packets hides, and never where it jumps back.
class TurnTracker {
 public:
  enum class Move : std::uint8_t {
    kSameRevolution,
    kNextRevolution,
    kImplausible,  ///< No motor turns so: backwards, or faster than 40 revolutions a second. Not followed.
    kRestart,      ///< After three implausible moves in a row, or a second of silence: a new beginning.
  };

  /// Cut: azimuth in hundredths of a degree at which revolutions begin, 0..35999.
  explicit TurnTracker(std::int32_t cut) : cut_(cut) {}

  /// The head's next azimuth (0..35999), at a time not before the last, by a turn of about `turn_per_ns`.
  [[nodiscard]] Move step(std::int32_t azimuth, std::int64_t time_ns, double turn_per_ns);

  /// The next step is a new beginning.
  void restart() { last_.reset(); }

 private:
  struct Place {
    std::int32_t from_cut = 0;
    std::int64_t time_ns = 0;
  };
  std::int32_t cut_;
  std::optional<Place> last_;
  int implausible_ = 0;
};

}  // namespace verge::sensor::velodyne
