// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "verge/core/bytes.hpp"
#include "verge/core/error.hpp"
#include "verge/sensor/ibeo/framer.hpp"

namespace verge::sensor::ibeo {

/// Header of a message of an ibeo ALASCA XT (TCP port 12000).
struct AlascaHeader {
  std::uint32_t bytes = 0;  ///< Body of this message.
  std::uint32_t type = 0;
  std::uint32_t time_ms = 0;

  friend bool operator==(const AlascaHeader&, const AlascaHeader&) = default;
};

inline constexpr std::uint32_t kAlascaScanType = 15;
inline constexpr std::size_t kAlascaHeaderBytes = 16;
inline constexpr std::size_t kAlascaPointsMost = 8648;
inline constexpr std::size_t kAlascaScanHeaderBytes = 16;
inline constexpr std::size_t kAlascaPointBytes = 12;

/// No message is longer than a scan of the most points: 103,808 B with its header.
inline constexpr FrameLayout kAlascaFrames{
    .magic = {std::byte{0xAF}, std::byte{0xFE}, std::byte{0xC0}, std::byte{0xC0}},
    .header_bytes = kAlascaHeaderBytes,
    .size_offset = 4,
    .body_max_bytes = kAlascaScanHeaderBytes + kAlascaPointsMost * kAlascaPointBytes};

/// The header in these 16 bytes, whose magic is right.
[[nodiscard]] AlascaHeader decode_alasca_header(Bytes header);
/// A whole message; the body's size is taken from the body.
[[nodiscard]] std::vector<std::byte> encode_alasca_message(const AlascaHeader& header, Bytes body);

/// What the sensor says of a point.
enum class AlascaStatus : std::uint8_t { kOk = 0, kInvalid = 1, kRain = 2, kGround = 3, kDirt = 4 };

/// One point, its coordinates in the compressed code: see metres_of_code().
struct AlascaPoint {
  std::uint8_t scanner = 0;
  std::uint8_t layer = 0;  ///< 0 = the lowest.
  std::uint8_t echo = 0;
  AlascaStatus status = AlascaStatus::kOk;
  std::int16_t x_code = 0;
  std::int16_t y_code = 0;
  std::int16_t z_code = 0;
  std::uint16_t pulse_width = 0;

  friend bool operator==(const AlascaPoint&, const AlascaPoint&) = default;
};

/// The compressed scan of an ALASCA XT as in a message of type 15, number by number: what is decoded encodes
/// to the same bytes.
struct AlascaScan {
  std::uint8_t version = 0;
  std::uint8_t scanner_type = 3;  ///< 3 = ALASCA XT.
  std::uint8_t ecu = 0;
  std::uint8_t reserved = 0;
  std::uint32_t time = 0;  ///< When the mirror was at angle 0, on the sensor's own clock.
  std::int16_t start_angle_1e4_rad = 0;
  std::int16_t end_angle_1e4_rad = 0;
  std::uint16_t number = 0;
  std::vector<AlascaPoint> points{};

  friend bool operator==(const AlascaScan&, const AlascaScan&) = default;
};

/// The metres that a coordinate's code stands for: centimetres up to 100 m, decimetres beyond.
/// |c| <= 10000: 0.01 c; beyond: 0.1 c -+ 900, so that 10001 is 100.1 m.
[[nodiscard]] double metres_of_code(std::int16_t code);
/// The code nearest to these metres; none beyond what a code can say (-2376.8 .. 2376.7 m, and a half step),
/// and for what is not finite. code_of_metres(metres_of_code(c)) == c for every c.
[[nodiscard]] std::optional<std::int16_t> code_of_metres(double metres);

/// The scan in the body of a message. Fails with kDamaged where the size is not 16 + 12 x points or there are
/// more than 8648 points.
[[nodiscard]] Expected<AlascaScan> decode_alasca_scan(Bytes body, std::uint64_t at = 0);
/// The body of the message. At most 8648 points.
[[nodiscard]] std::vector<std::byte> encode_alasca_scan(const AlascaScan& scan);

}  // namespace verge::sensor::ibeo
