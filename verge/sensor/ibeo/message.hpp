// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "verge/core/bytes.hpp"
#include "verge/sensor/ibeo/framer.hpp"

namespace verge::sensor::ibeo {

// Types of the messages that we know. Others are skipped by their size.
inline constexpr std::uint16_t kHealthType = 0x2030;
inline constexpr std::uint16_t kScanType = 0x2202;
inline constexpr std::uint16_t kObjectsType = 0x2221;
inline constexpr std::uint16_t kVehicleStateType = 0x2805;
inline constexpr std::uint16_t kIdcTrailerType = 0x6120;
inline constexpr std::uint16_t kIdcIndexType = 0x6130;
/// What a sensor says of itself on the wire, and a separator in a file: nothing of it is used.
inline constexpr std::uint16_t kSensorInfoType = 0x7100;

/// Header of every message of an ibeo LUX or SICK LD-MRS, on the wire (TCP port 12002) and in an .idc file.
/// Source: ibeo's Ethernet data protocol as public drivers state it (docs/formats_ibeo.md).
struct MessageHeader {
  std::uint32_t previous_bytes =
      0;                    ///< Body of the message before; 0 on the wire and at the first of a file.
  std::uint32_t bytes = 0;  ///< Body of this message.
  std::uint8_t reserved = 0;
  std::uint8_t device = 0;  ///< 0 from a sensor itself; which of several sensors in a recording.
  std::uint16_t type = 0;
  std::uint64_t ntp = 0;  ///< When the message was made; see unix_ns_of().

  friend bool operator==(const MessageHeader&, const MessageHeader&) = default;
};

inline constexpr std::size_t kHeaderBytes = 24;

/// Messages beyond 8 MiB are not believed: the largest scan is 655,394 B.
inline constexpr FrameLayout kLuxFrames{
    .magic = {std::byte{0xAF}, std::byte{0xFE}, std::byte{0xC0}, std::byte{0xC2}},
    .header_bytes = kHeaderBytes,
    .size_offset = 8,
    .body_max_bytes = 8U << 20U};

/// The header in these 24 bytes, whose magic is right.
[[nodiscard]] MessageHeader decode_header(Bytes header);

/// A whole message; the body's size is taken from the body.
[[nodiscard]] std::vector<std::byte> encode_message(const MessageHeader& header, Bytes body);

}  // namespace verge::sensor::ibeo
