// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

namespace verge::sensor::velodyne {

/// Of a stamp in microseconds of the hour, the whole time.
struct HourTime {
  std::int64_t time_ns = 0;
  bool ambiguous = false;  ///< The reference is half an hour away, give or take a second.
};

/// The time nearest to the reference (at most half an hour from it) whose hour began `stamp_us` before it.
/// Stamps beyond the hour (seen shortly before the wrap, ros-drivers/velodyne#218) count on. Both in ns since
/// the Unix epoch.
[[nodiscard]] HourTime time_of_hour(std::uint32_t stamp_us, std::int64_t reference_ns);

/// Turns the stamps of one sensor's packets into times. The hour comes from the reference once; after that
/// each stamp is placed nearest to where the packets before lead one to expect it, so that a host clock that
/// is wrong by less than half an hour, or is set meanwhile, moves nothing.
class StampClock {
 public:
  struct Reading {
    std::int64_t time_ns = 0;
    bool estimated = false;  ///< The stamp makes no sense here; the time is what was expected.
    bool jumped = false;  ///< The sensor's clock was set: two stamps agree with each other, not with before.
    bool ambiguous = false;
  };

  /// Of a packet with that stamp, received at `received_ns`, that lasts `packet_ns`.
  [[nodiscard]] Reading read(std::uint32_t stamp_us, std::int64_t received_ns, std::int64_t packet_ns);

  /// Of a packet of a sensor without a clock: when it was received, without the jitter of the network (up to
  /// 20 ms): a sixteenth of each difference from a steady stream is followed.
  [[nodiscard]] Reading read_received(std::int64_t received_ns, std::int64_t packet_ns);

  /// A better reference for the hour than the host's clock: the time of day `utc_ns` at `received_ns`. Counts
  /// until the first packet, and then only tells whether the hour was right.
  void set_reference(std::int64_t utc_ns, std::int64_t received_ns);

  /// Whether a reference set later says another hour than the one in use.
  [[nodiscard]] bool hour_disputed() const { return hour_disputed_; }

 private:
  [[nodiscard]] std::int64_t expected(std::int64_t received_ns) const;
  /// Whether counting on has led more than a day away from the host's clock: one of them was set.
  [[nodiscard]] bool strayed(std::int64_t received_ns) const;
  Reading begin(std::uint32_t stamp_us, std::int64_t received_ns);

  bool begun_ = false;
  std::int64_t last_ns_ = 0;
  std::int64_t last_received_ns_ = 0;
  std::optional<std::int64_t> suspect_ns_;  // a time that did not fit; a second one near it is a jump
  std::optional<std::int64_t> utc_minus_host_ns_;
  bool hour_disputed_ = false;
};

}  // namespace verge::sensor::velodyne
