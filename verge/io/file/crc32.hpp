// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "verge/core/bytes.hpp"

namespace verge::io {

constexpr std::array<std::uint32_t, 256> crc32_table() {
  std::array<std::uint32_t, 256> table{};
  for (std::uint32_t i = 0; i < table.size(); ++i) {
    std::uint32_t rest = i;
    for (int bit = 0; bit < 8; ++bit) rest = (rest >> 1U) ^ ((rest & 1U) != 0 ? 0xEDB88320U : 0U);
    table[i] = rest;
  }
  return table;
}

/// CRC-32 of ISO 3309 (as zlib, PNG and MCAP have it: reflected, polynomial 0xEDB88320), piece by piece.
class Crc32 {
 public:
  void add(Bytes bytes) {
    for (const std::byte byte : bytes) {
      const auto index = static_cast<std::uint8_t>(state_ ^ static_cast<std::uint32_t>(byte));
      state_ = kTable[index] ^ (state_ >> 8U);
    }
  }
  [[nodiscard]] std::uint32_t value() const { return ~state_; }

 private:
  static constexpr std::array<std::uint32_t, 256> kTable = crc32_table();

  std::uint32_t state_ = 0xFFFF'FFFFU;
};

[[nodiscard]] inline std::uint32_t crc32(Bytes bytes) {
  Crc32 crc;
  crc.add(bytes);
  return crc.value();
}

}  // namespace verge::io
