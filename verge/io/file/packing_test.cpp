// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/io/file/packing.hpp"

#include <algorithm>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "verge/io/file/crc32.hpp"
#include "verge/io/test_files.hpp"

namespace verge::io {
namespace {

using testing::bytes_of;

constexpr auto kPackings = {Packing::kNone, Packing::kLz4, Packing::kZstd};

}  // namespace

TEST(Crc32, OfTheDigitsIsThePublishedCheckValue) {
  EXPECT_EQ(crc32(bytes_of("123456789")), 0xCBF43926U);
  EXPECT_EQ(crc32({}), 0U);
}

// Bit by bit, as the standard writes it.
TEST(Crc32, OfAnyLengthAndInPiecesIsThatOfItsBits) {
  std::string text;
  std::uint32_t bits = 0xFFFF'FFFFU;
  for (std::size_t length = 0; length < 64; ++length) {
    EXPECT_EQ(crc32(bytes_of(text)), ~bits) << length;
    for (std::size_t cut = 0; cut <= length; cut += 5) {
      Crc32 pieces;
      pieces.add(bytes_of(text).first(cut));
      pieces.add(bytes_of(text).subspan(cut));
      EXPECT_EQ(pieces.value(), ~bits) << length << ", cut at " << cut;
    }
    const auto next = static_cast<unsigned char>(37 * length + 201);
    text += static_cast<char>(next);
    bits ^= next;
    for (int bit = 0; bit < 8; ++bit) bits = (bits >> 1U) ^ ((bits & 1U) != 0 ? 0xEDB88320U : 0U);
  }
}

TEST(Packing, NamesAreThoseOfMcapAndOfBags) {
  EXPECT_EQ(packing_of(""), Packing::kNone);
  EXPECT_EQ(packing_of("none"), Packing::kNone);
  EXPECT_EQ(packing_of("lz4"), Packing::kLz4);
  EXPECT_EQ(packing_of("zstd"), Packing::kZstd);
  EXPECT_EQ(packing_of("bz2"), Packing::kBz2);
  EXPECT_FALSE(packing_of("snappy"));
}

RC_GTEST_PROP(Packing, WhatIsPackedUnpacksToItsSizeAndToNoOther, (const std::string& some)) {
  std::string text;
  for (int i = 0; i < 50; ++i) text += some;  // something to compress
  for (const Packing packing : kPackings) {
    const std::string packed = pack(packing, bytes_of(text));
    std::vector<std::byte> out(text.size());
    RC_ASSERT(unpack(packing, bytes_of(packed), out));
    RC_ASSERT(std::equal(out.begin(), out.end(), bytes_of(text).begin()));
    std::vector<std::byte> larger(text.size() + 1);
    RC_ASSERT(!unpack(packing, bytes_of(packed), larger));
    if (text.empty()) continue;
    std::vector<std::byte> smaller(text.size() - 1);
    RC_ASSERT(!unpack(packing, bytes_of(packed), smaller));
    RC_ASSERT(!unpack(packing, bytes_of(packed).first(packed.size() - 1), out));
  }
}

TEST(Packing, ZstdTellsItsSize) {
  const std::string packed = pack(Packing::kZstd, bytes_of(std::string(1000, 'a')));
  EXPECT_TRUE(is_zstd(bytes_of(packed)));
  EXPECT_EQ(zstd_size(bytes_of(packed)), 1000U);
  EXPECT_FALSE(is_zstd(bytes_of(std::string("\0\1\0\0", 4))));
}

}  // namespace verge::io
