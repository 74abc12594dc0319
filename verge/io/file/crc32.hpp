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

/// Table k is what table 0 makes of a byte with k bytes of zeros behind it.
constexpr std::array<std::array<std::uint32_t, 256>, 8> crc32_tables() {
  std::array<std::array<std::uint32_t, 256>, 8> tables{crc32_table()};
  for (std::size_t k = 1; k < tables.size(); ++k) {
    for (std::size_t i = 0; i < 256; ++i)
      tables[k][i] = tables[0][tables[k - 1][i] & 0xFFU] ^ (tables[k - 1][i] >> 8U);
  }
  return tables;
}

/// CRC-32 of ISO 3309 (as zlib, PNG and MCAP have it: reflected, polynomial 0xEDB88320), piece by piece;
/// eight bytes at a time, because a recording's chunks are many megabytes.
class Crc32 {
 public:
  void add(Bytes bytes) {
    for (; bytes.size() >= 8; bytes = bytes.subspan(8))
      add_eight(load_le<std::uint32_t>(bytes, 0) ^ state_, load_le<std::uint32_t>(bytes, 4));
    for (const std::byte byte : bytes) {
      const auto index = static_cast<std::uint8_t>(state_ ^ static_cast<std::uint32_t>(byte));
      state_ = kTables[0][index] ^ (state_ >> 8U);
    }
  }
  [[nodiscard]] std::uint32_t value() const { return ~state_; }

 private:
  void add_eight(std::uint32_t low, std::uint32_t high) {
    state_ = kTables[7][low & 0xFFU] ^ kTables[6][(low >> 8U) & 0xFFU] ^ kTables[5][(low >> 16U) & 0xFFU] ^
             kTables[4][low >> 24U] ^ kTables[3][high & 0xFFU] ^ kTables[2][(high >> 8U) & 0xFFU] ^
             kTables[1][(high >> 16U) & 0xFFU] ^ kTables[0][high >> 24U];
  }

  static constexpr std::array<std::array<std::uint32_t, 256>, 8> kTables = crc32_tables();

  std::uint32_t state_ = 0xFFFF'FFFFU;
};

[[nodiscard]] inline std::uint32_t crc32(Bytes bytes) {
  Crc32 crc;
  crc.add(bytes);
  return crc.value();
}

}  // namespace verge::io
