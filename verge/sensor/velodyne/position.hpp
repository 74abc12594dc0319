// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "verge/core/bytes.hpp"
#include "verge/sensor/velodyne/packet.hpp"

namespace verge::sensor::velodyne {

/// Pulse a second from the GPS receiver, as the sensor sees it.
enum class Pps : std::uint8_t { kAbsent, kSynchronising, kLocked, kError };

/// One of the three two-axis inertial units.
struct InertialReading {
  double gyro_rad_s = 0.0;
  double temperature_c = 0.0;
  double acceleration_x_mps2 = 0.0;
  double acceleration_y_mps2 = 0.0;
};

/// What became of the sentence of a position packet.
enum class NmeaFault : std::uint8_t {
  kNone,        ///< Time and date, checksum right.
  kNoSentence,  ///< Nothing that begins with $GPRMC or $GNRMC.
  kNoChecksum,  ///< No '*' with two hexadecimal digits behind it.
  kBadChecksum,
  kBadTime,  ///< Fields missing, or no such date or time of day.
};

/// Recommended minimum sentence.
struct NmeaReading {
  NmeaFault fault = NmeaFault::kNoSentence;
  std::int64_t utc_ns = 0;  ///< Since the Unix epoch; only without a fault.
  bool locked = false;      ///< Status A; V means that the receiver only guesses.
};

/// The last RMC sentence of `text` (several may follow each other; $GPGGA has no date and does not count).
/// Years 80..99 are 19xx; second 60 is the leap second and counts as the next minute's 0.
[[nodiscard]] NmeaReading read_nmea(std::string_view text);

/// Whether a receiver's date is 1024 weeks (or a multiple) before the host's, within a week: its week counter
/// has rolled over.
[[nodiscard]] bool week_rolled_over(std::int64_t utc_ns, std::int64_t host_ns);

/// A position packet (UDP payload of 512 bytes).
struct PositionPacket {
  std::array<InertialReading, 3> inertial{};
  std::uint32_t stamp_us = 0;  ///< Since the top of the hour.
  Pps pps = Pps::kAbsent;      ///< kAbsent too from firmware that does not say it.
  std::string sentence;        ///< NMEA text up to its terminator or the packet's end.
  NmeaReading nmea{};
};

/// Exactly kPositionBytes of `payload`; defined for every content. Source: docs/formats_velodyne.md.
[[nodiscard]] PositionPacket parse_position(Bytes payload);

using PositionBytes = std::array<std::byte, kPositionBytes>;

/// The position packet of a sensor at that time whose receiver is locked: stamp, pulse a second, and the RMC
/// sentence of the second that has begun, at 0 degrees north and east. The sensor does not move (inertial
/// readings of 0). The year of the sentence has two digits: 1980 to 2079 can be said.
[[nodiscard]] PositionBytes locked_position(std::int64_t utc_ns);

}  // namespace verge::sensor::velodyne
