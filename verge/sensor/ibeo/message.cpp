// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/sensor/ibeo/message.hpp"

#include <utility>

#include "verge/core/byte_writer.hpp"

namespace verge::sensor::ibeo {

MessageHeader decode_header(Bytes header) {
  return {.previous_bytes = load_be<std::uint32_t>(header, 4),
          .bytes = load_be<std::uint32_t>(header, 8),
          .reserved = load_be<std::uint8_t>(header, 12),
          .device = load_be<std::uint8_t>(header, 13),
          .type = load_be<std::uint16_t>(header, 14),
          .ntp = load_be<std::uint64_t>(header, 16)};
}

std::vector<std::byte> encode_message(const MessageHeader& header, Bytes body) {
  ByteWriter out;
  out.bytes(kLuxFrames.magic).be(header.previous_bytes).be(static_cast<std::uint32_t>(body.size()));
  out.be(header.reserved).be(header.device).be(header.type).be(header.ntp).bytes(body);
  return std::move(out).take();
}

}  // namespace verge::sensor::ibeo
