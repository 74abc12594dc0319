// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "verge/core/bytes.hpp"
#include "verge/core/error.hpp"
#include "verge/sensor/ibeo/message.hpp"

namespace verge::sensor::ibeo {

/// Which messages begin a new frame of the index.
struct FrameTrigger {
  std::uint16_t type = kScanType;
  std::uint8_t device = 255;  ///< 255 = any.

  friend bool operator==(const FrameTrigger&, const FrameTrigger&) = default;
};

/// Where a frame begins.
struct IndexEntry {
  std::uint64_t file_offset = 0;  ///< Of the message's header.
  std::uint64_t time_offset_ms = 0;
  std::uint8_t device = 255;

  friend bool operator==(const IndexEntry&, const IndexEntry&) = default;
};

/// The frame index at the end of an .idc file, as in a message of type 0x6130.
struct FrameIndex {
  std::uint8_t major = 1;
  std::uint8_t minor = 0;
  std::string name{};  ///< At most 17 characters.
  std::uint64_t time_offset_ms = 0;
  bool trigger_in_new_frame = true;
  std::vector<FrameTrigger> triggers{};  ///< At most 30.
  std::vector<IndexEntry> entries{};

  friend bool operator==(const FrameIndex&, const FrameIndex&) = default;
};

/// The index in the body of a message; the body stands at `at` in the file. Fails with kDamaged where its
/// counts do not fit its size or an entry does not point before the index: a reader then does without it.
[[nodiscard]] Expected<FrameIndex> decode_frame_index(Bytes body, std::uint64_t at);
[[nodiscard]] std::vector<std::byte> encode_frame_index(const FrameIndex& index);

/// Makes an .idc file, message by message: fills in the size of the message before, keeps the index of the
/// frames (a scan begins one), and closes with the index and the trailer as a recorder does.
class IdcWriter {
 public:
  /// The bytes to append for this message. Its previous_bytes is filled in.
  [[nodiscard]] std::vector<std::byte> add(MessageHeader header, Bytes body);
  /// The bytes to append at the end: frame index and trailer, at the time of the last message.
  [[nodiscard]] std::vector<std::byte> close();

 private:
  std::uint64_t file_bytes_ = 0;
  std::uint32_t previous_bytes_ = 0;
  std::optional<std::uint64_t> first_ntp_;
  std::uint64_t last_ntp_ = 0;
  std::vector<IndexEntry> entries_;
};

}  // namespace verge::sensor::ibeo
