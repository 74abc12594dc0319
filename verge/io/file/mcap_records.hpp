// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "verge/core/bytes.hpp"
#include "verge/io/file/ros_wire.hpp"

// The records of MCAP (docs/formats_ros.md names the specification).

namespace verge::io {

/// What a file begins and ends with.
inline constexpr std::string_view kMcapMagic("\x89MCAP0\r\n", 8);

/// One byte before the length of each record.
enum class McapOp : std::uint8_t {
  kHeader = 0x01,
  kFooter = 0x02,
  kSchema = 0x03,
  kChannel = 0x04,
  kMessage = 0x05,
  kChunk = 0x06,
  kMessageIndex = 0x07,
  kChunkIndex = 0x08,
  kStatistics = 0x0B,
  kSummaryOffset = 0x0E,
  kDataEnd = 0x0F,
};

/// Bytes before a record's content: the operation and a length of 8 bytes.
inline constexpr std::uint64_t kMcapRecordHead = 9;
inline constexpr std::uint64_t kMcapFooterBytes = 20;

struct McapSchema {
  std::uint16_t id = 0;
  std::string name;      ///< Type of the messages.
  std::string encoding;  ///< "ros2msg", "ros1msg", ...
  std::string text;
};

struct McapChannel {
  std::uint16_t id = 0;
  std::uint16_t schema = 0;  ///< 0: none.
  std::string topic;
  std::string encoding;  ///< Of the messages: "cdr", "ros1", ...
};

struct McapChunk {
  std::uint64_t unpacked_bytes = 0;
  std::uint32_t crc = 0;  ///< Of the unpacked records; 0: not known.
  std::string packing;
  std::uint64_t packed_bytes = 0;
  std::uint64_t head_bytes = 0;  ///< Of the chunk's content before the packed records.
};

struct McapFooter {
  std::uint64_t summary_start = 0;  ///< 0: there is none.
  std::uint64_t summary_offset_start = 0;
  std::uint32_t summary_crc = 0;
};

/// Each reads the content of one record; where it does not fit, the reader has a fault. MCAP has numbers and
/// texts as ROS 1 does, so that the reader is one of Wire::kRos1.
[[nodiscard]] McapSchema read_mcap_schema(MessageReader& reader);
[[nodiscard]] McapChannel read_mcap_channel(MessageReader& reader);
[[nodiscard]] McapChunk read_mcap_chunk(MessageReader& reader);
[[nodiscard]] McapFooter read_mcap_footer(MessageReader& reader);

}  // namespace verge::io
