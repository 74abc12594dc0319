// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "verge/core/bytes.hpp"
#include "verge/core/error.hpp"

namespace verge::sensor::ibeo {

/// How the sensor sits on the vehicle, as it was told. Turned by yaw, then pitch, then roll, in angle ticks;
/// shifted from the middle of the rear axle, in cm. The points of a scan are not moved by it: they stay in
/// the sensor's frame.
struct Mounting {
  std::int16_t yaw_ticks = 0;
  std::int16_t pitch_ticks = 0;
  std::int16_t roll_ticks = 0;
  std::int16_t x_cm = 0;
  std::int16_t y_cm = 0;
  std::int16_t z_cm = 0;

  friend bool operator==(const Mounting&, const Mounting&) = default;
};

/// What the sensor says of a return.
enum PointFlag : std::uint8_t { kTransparent = 0x01, kClutter = 0x02, kGround = 0x04, kDirt = 0x08 };

/// What the sensor says of a scan.
enum ScanFlag : std::uint16_t {
  kGroundLabelled = 0x0001,
  kDirtLabelled = 0x0002,
  kRainLabelled = 0x0004,
  kTransparencyLabelled = 0x0020,
  kHorizontalOffsetAdded = 0x0040,
  kRearMirror = 0x0400,  ///< Which side of the mirror made this scan: 0 the front, 1 the rear.
};

/// One return.
struct LuxPoint {
  std::uint8_t layer = 0;        ///< 0 = the lowest; 4 bits.
  std::uint8_t echo = 0;         ///< 0 = the first; 4 bits.
  std::uint8_t flags = 0;        ///< PointFlag.
  std::int16_t angle_ticks = 0;  ///< Positive to the left.
  std::uint16_t range_cm = 0;    ///< 0 = no return.
  std::uint16_t pulse_width_cm = 0;
  std::uint16_t reserved = 0;

  friend bool operator==(const LuxPoint&, const LuxPoint&) = default;
};

/// One scan of an ibeo LUX or SICK LD-MRS as it stands in a message of type 0x2202, number by number: what is
/// decoded encodes to the same bytes.
///
/// A rotating mirror with two sides sends one scan a side, from the left (start) to the right (end). Each
/// laser pulse is seen by two of the four layers at once: 0 and 1, or 2 and 3. The pairs take turns, so that
/// their azimuths interlace half a step apart, and each pair is missing at one end of the field of view.
struct LuxScan {
  std::uint16_t number = 0;
  std::uint16_t status =
      0;  ///< 0x0001 motor on, 0x0002 laser on, 0x0008 frequency reached, 0x8000 upside down.
  std::uint16_t sync_phase_offset = 0;
  std::uint64_t start_ntp = 0;
  std::uint64_t end_ntp = 0;
  std::uint16_t ticks_per_turn = 11520;  ///< 32 a degree.
  std::int16_t start_angle_ticks = 0;
  std::int16_t end_angle_ticks = 0;
  Mounting mounting{};
  std::uint16_t flags = 0;  ///< ScanFlag.
  std::vector<LuxPoint> points{};

  friend bool operator==(const LuxScan&, const LuxScan&) = default;
};

inline constexpr std::size_t kScanHeaderBytes = 44;
inline constexpr std::size_t kScanPointBytes = 10;

/// The scan in the body of a message. `at`: where the body stands in the recording, for errors. Fails with
/// kDamaged where the size is not 44 + 10 x points, a turn has no ticks, or the scan ends before it starts.
/// Layers and echoes stay as they are: judging them is cloud_of()'s.
[[nodiscard]] Expected<LuxScan> decode_scan(Bytes body, std::uint64_t at = 0);

/// The body of the message. At most 65535 points.
[[nodiscard]] std::vector<std::byte> encode_scan(const LuxScan& scan);

}  // namespace verge::sensor::ibeo
