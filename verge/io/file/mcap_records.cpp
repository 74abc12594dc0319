// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/io/file/mcap_records.hpp"

namespace verge::io {

McapSchema read_mcap_schema(MessageReader& reader) {
  McapSchema out;
  out.id = reader.number<std::uint16_t>();
  out.name = reader.text();
  out.encoding = reader.text();
  out.text = reader.text();
  return out;
}

McapChannel read_mcap_channel(MessageReader& reader) {
  McapChannel out;
  out.id = reader.number<std::uint16_t>();
  out.schema = reader.number<std::uint16_t>();
  out.topic = reader.text();
  out.encoding = reader.text();
  return out;  // the metadata behind it say nothing that we need
}

McapChunk read_mcap_chunk(MessageReader& reader) {
  McapChunk out;
  static_cast<void>(reader.number<std::uint64_t>());  // first and last time of its messages
  static_cast<void>(reader.number<std::uint64_t>());
  out.unpacked_bytes = reader.number<std::uint64_t>();
  out.crc = reader.number<std::uint32_t>();
  out.packing = reader.text();
  out.packed_bytes = reader.number<std::uint64_t>();
  out.head_bytes = reader.offset();
  return out;
}

McapFooter read_mcap_footer(MessageReader& reader) {
  McapFooter out;
  out.summary_start = reader.number<std::uint64_t>();
  out.summary_offset_start = reader.number<std::uint64_t>();
  out.summary_crc = reader.number<std::uint32_t>();
  return out;
}

}  // namespace verge::io
