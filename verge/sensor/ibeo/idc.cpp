// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/sensor/ibeo/idc.hpp"

#include <cassert>
#include <utility>

#include "verge/core/byte_writer.hpp"
#include "verge/sensor/ibeo/damaged.hpp"
#include "verge/sensor/ibeo/ntp.hpp"

namespace verge::sensor::ibeo {
namespace {

// Body of the index: 128 bytes of header, then the entries.
constexpr std::size_t kNameOffset = 2;
constexpr std::size_t kNameBytes = 17;
constexpr std::size_t kCountOffset = 19;
constexpr std::size_t kTimeOffset = 27;
constexpr std::size_t kPolicyOffset = 35;
constexpr std::size_t kTriggersOffset = 38;
constexpr std::size_t kTriggerBytes = 3;
constexpr std::size_t kIndexHeaderBytes = 128;
constexpr std::size_t kTriggersMost = (kIndexHeaderBytes - kTriggersOffset) / kTriggerBytes;
constexpr std::size_t kEntryBytes = 17;

std::string name_of(Bytes body) {
  std::string name;
  for (std::size_t i = 0; i < kNameBytes; ++i)
    name += static_cast<char>(load_be<std::uint8_t>(body, kNameOffset + i));
  return name.substr(0, name.find_last_not_of('\0') + 1);
}

IndexEntry decode_entry(Bytes entry) {
  return {load_be<std::uint64_t>(entry, 0), load_be<std::uint64_t>(entry, 8),
          load_be<std::uint8_t>(entry, 16)};
}

/// The header of the index without its entries.
FrameIndex decode_index_header(Bytes body, std::size_t triggers) {
  FrameIndex index{.major = load_be<std::uint8_t>(body, 0),
                   .minor = load_be<std::uint8_t>(body, 1),
                   .name = name_of(body),
                   .time_offset_ms = load_be<std::uint64_t>(body, kTimeOffset),
                   .trigger_in_new_frame = load_be<std::uint8_t>(body, kPolicyOffset) != 0,
                   .triggers = {},
                   .entries = {}};
  for (std::size_t i = 0; i < triggers; ++i) {
    const std::size_t at = kTriggersOffset + i * kTriggerBytes;
    index.triggers.push_back({load_be<std::uint16_t>(body, at), load_be<std::uint8_t>(body, at + 2)});
  }
  return index;
}

}  // namespace

Expected<FrameIndex> decode_frame_index(Bytes body, std::uint64_t at) {
  if (body.size() < kIndexHeaderBytes) {
    return damaged(at, "frame index is shorter than its header", fmt::format("{} B", body.size()),
                   ">= 128 B");
  }
  const auto triggers = load_be<std::uint16_t>(body, kPolicyOffset + 1);
  if (triggers > kTriggersMost) {
    return damaged(at + kPolicyOffset + 1, "frame index has too many triggers", fmt::format("{}", triggers),
                   fmt::format("<= {}", kTriggersMost));
  }
  const auto count = load_be<std::uint64_t>(body, kCountOffset);
  const std::uint64_t most = (body.size() - kIndexHeaderBytes) / kEntryBytes;
  if (count > most) {
    return damaged(at + kCountOffset, "frame index has more entries than its size allows",
                   fmt::format("{}", count), fmt::format("<= {}", most));
  }
  FrameIndex index = decode_index_header(body, triggers);
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t offset = kIndexHeaderBytes + i * kEntryBytes;
    index.entries.push_back(decode_entry(body.subspan(offset, kEntryBytes)));
    if (index.entries.back().file_offset >= at) {
      return damaged(at + offset, "frame index points behind itself",
                     fmt::format("{}", index.entries.back().file_offset), fmt::format("< {}", at));
    }
  }
  return index;
}

std::vector<std::byte> encode_frame_index(const FrameIndex& index) {
  assert(index.name.size() <= kNameBytes && index.triggers.size() <= kTriggersMost);
  ByteWriter out;
  out.be(index.major).be(index.minor);
  out.bytes(std::as_bytes(std::span(index.name.data(), index.name.size())))
      .zeros(kNameBytes - index.name.size());
  out.be(static_cast<std::uint64_t>(index.entries.size())).be(index.time_offset_ms);
  out.be(static_cast<std::uint8_t>(index.trigger_in_new_frame ? 1 : 0));
  out.be(static_cast<std::uint16_t>(index.triggers.size()));
  for (const FrameTrigger& trigger : index.triggers) out.be(trigger.type).be(trigger.device);
  out.zeros(kIndexHeaderBytes - out.size());
  for (const IndexEntry& entry : index.entries) {
    out.be(entry.file_offset).be(entry.time_offset_ms).be(entry.device);
  }
  return std::move(out).take();
}

std::vector<std::byte> IdcWriter::add(MessageHeader header, Bytes body) {
  header.previous_bytes = previous_bytes_;
  if (!first_ntp_) first_ntp_ = header.ntp;
  last_ntp_ = header.ntp;
  if (header.type == kScanType) {
    const double since_first = header.ntp < *first_ntp_ ? 0.0 : seconds_between(*first_ntp_, header.ntp);
    entries_.push_back({file_bytes_, static_cast<std::uint64_t>(since_first * 1e3), header.device});
  }
  std::vector<std::byte> bytes = encode_message(header, body);
  file_bytes_ += bytes.size();
  previous_bytes_ = static_cast<std::uint32_t>(body.size());
  return bytes;
}

std::vector<std::byte> IdcWriter::close() {
  const FrameIndex index{
      .name = "verge", .triggers = {FrameTrigger{}}, .entries = std::exchange(entries_, {})};
  std::vector<std::byte> bytes = add({.type = kIdcIndexType, .ntp = last_ntp_}, encode_frame_index(index));
  const std::vector<std::byte> trailer = add({.type = kIdcTrailerType, .ntp = last_ntp_}, {});
  bytes.insert(bytes.end(), trailer.begin(), trailer.end());
  return bytes;
}

}  // namespace verge::sensor::ibeo
