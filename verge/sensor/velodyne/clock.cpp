// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/sensor/velodyne/clock.hpp"

#include <cstdlib>

namespace verge::sensor::velodyne {
namespace {

constexpr std::int64_t kSecondNs = 1'000'000'000;
constexpr std::int64_t kHourNs = 3600 * kSecondNs;
constexpr std::int64_t kDayNs = 24 * kHourNs;
constexpr std::int64_t kHalfHourNs = kHourNs / 2;
constexpr std::int64_t kPlausibleNs = kSecondNs;
// A stamp is at most this late in wrapping; one beyond is damaged.
constexpr std::uint32_t kStampEndUs = 3'601'000'000U;

std::int64_t floor_to_hour(std::int64_t time_ns) {
  const std::int64_t into = time_ns % kHourNs;
  return time_ns - (into < 0 ? into + kHourNs : into);
}

bool near(std::int64_t a_ns, std::int64_t b_ns) { return std::abs(a_ns - b_ns) <= kPlausibleNs; }

}  // namespace

HourTime time_of_hour(std::uint32_t stamp_us, std::int64_t reference_ns) {
  std::int64_t time_ns = floor_to_hour(reference_ns) + static_cast<std::int64_t>(stamp_us) * 1000;
  if (time_ns > reference_ns + kHalfHourNs) time_ns -= kHourNs;
  if (time_ns < reference_ns - kHalfHourNs) time_ns += kHourNs;
  const std::int64_t away_ns = std::abs(time_ns - reference_ns);
  return {time_ns, std::abs(away_ns - kHalfHourNs) < kSecondNs};
}

void StampClock::set_reference(std::int64_t utc_ns, std::int64_t received_ns) {
  utc_minus_host_ns_ = utc_ns - received_ns;
  if (begun_) hour_disputed_ = std::abs(utc_ns - expected(received_ns)) > kHalfHourNs;
}

std::int64_t StampClock::expected(std::int64_t received_ns) const {
  const std::int64_t since_ns = received_ns - last_received_ns_;
  return last_ns_ + (since_ns > 0 ? since_ns : 0);
}

bool StampClock::strayed(std::int64_t received_ns) const {
  return std::abs(expected(received_ns) - received_ns - utc_minus_host_ns_.value_or(0)) > kDayNs;
}

StampClock::Reading StampClock::begin(std::uint32_t stamp_us, std::int64_t received_ns) {
  const std::int64_t reference_ns = received_ns + utc_minus_host_ns_.value_or(0);
  const bool usable = stamp_us < kStampEndUs;
  const HourTime time = usable ? time_of_hour(stamp_us, reference_ns) : HourTime{reference_ns, false};
  begun_ = usable;
  return {time.time_ns, !usable, false, time.ambiguous};
}

StampClock::Reading StampClock::read(std::uint32_t stamp_us, std::int64_t received_ns,
                                     std::int64_t packet_ns) {
  Reading reading;
  if (!begun_ || strayed(received_ns)) {
    const bool again = begun_;
    reading = begin(stamp_us, received_ns);
    reading.jumped = again;
  } else {
    const std::int64_t expected_ns = expected(received_ns);
    // A stamp that goes on from the last one does so whatever the host's clock says meanwhile, be it set by
    // an hour. (A pause of whole hours, to the second, would be missed.)
    const std::int64_t going_on_ns = time_of_hour(stamp_us, last_ns_).time_ns;
    reading.time_ns = near(going_on_ns, last_ns_) ? going_on_ns : time_of_hour(stamp_us, expected_ns).time_ns;
    const bool usable = stamp_us < kStampEndUs;
    const bool fits = usable && (near(reading.time_ns, expected_ns) || near(reading.time_ns, last_ns_));
    reading.jumped = usable && !fits && suspect_ns_ && near(reading.time_ns, *suspect_ns_);
    reading.estimated = !fits && !reading.jumped;
    suspect_ns_.reset();
    if (reading.estimated) {
      suspect_ns_ = reading.time_ns;
      reading.time_ns = last_ns_ + packet_ns;
    }
  }
  last_ns_ = reading.time_ns;
  last_received_ns_ = received_ns;
  return reading;
}

StampClock::Reading StampClock::read_received(std::int64_t received_ns, std::int64_t packet_ns) {
  constexpr std::int64_t kJitterNs = 20'000'000;
  constexpr std::int64_t kFollow = 16;  // share of the difference that is followed
  Reading reading{received_ns, false, false, false};
  const std::int64_t expected_ns = last_ns_ + packet_ns;
  const std::int64_t off_ns = received_ns - expected_ns;
  if (begun_ && std::abs(off_ns) < kJitterNs) reading.time_ns = expected_ns + off_ns / kFollow;
  if (begun_ && off_ns <= -kJitterNs) reading.jumped = true;
  begun_ = true;
  last_ns_ = reading.time_ns;
  last_received_ns_ = received_ns;
  return reading;
}

}  // namespace verge::sensor::velodyne
