// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/io/file/lzf.hpp"

#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "verge/io/test_files.hpp"
#include "verge/io/text.hpp"

namespace verge::io {
namespace {

/// What came out; "!N": a fault at N.
std::string unpacked(std::string_view packed, std::size_t size) {
  std::vector<std::byte> out(size);
  if (const auto fault = unpack_lzf(testing::bytes_of(packed), out)) return "!" + std::to_string(*fault);
  return std::string(as_text(out));
}

std::string control(std::initializer_list<int> bytes) {
  std::string text;
  for (const int byte : bytes) text += static_cast<char>(byte);
  return text;
}

}  // namespace

TEST(Lzf, LiteralsAreCopied) {
  EXPECT_EQ(unpacked(control({4}) + "verge", 5), "verge");
  EXPECT_EQ(unpacked("", 0), "");
}

TEST(Lzf, CopiesGoBackAndMayOverlapThemselves) {
  // Three literals, then (1 << 5) = 3 bytes from distance 3.
  EXPECT_EQ(unpacked(control({2}) + "abc" + control({1 << 5, 2}), 6), "abcabc");
  // One literal, then 7 << 5 | 0: 9 + 4 = 13 bytes from distance 1.
  EXPECT_EQ(unpacked(control({0}) + "a" + control({7 << 5, 4, 0}), 14), std::string(14, 'a'));
}

TEST(Lzf, LongDistancesUseFiveMoreBits) {
  std::string packed;
  std::string want;
  for (int block = 0; block < 20; ++block) {  // 640 bytes of literals
    const std::string literal(32, static_cast<char>('a' + block));
    packed += control({31}) + literal;
    want += literal;
  }
  // Distance 640 = (2 << 8 | 127) + 1, length 3.
  EXPECT_EQ(unpacked(packed + control({(1 << 5) | 2, 127}), 643), want + "aaa");
}

TEST(Lzf, WhatDoesNotFitIsAFaultWhereItsControlByteStands) {
  EXPECT_EQ(unpacked(control({4}) + "ver", 5), "!0");                       // literals end early
  EXPECT_EQ(unpacked(control({4}) + "verge", 4), "!0");                     // no room
  EXPECT_EQ(unpacked(control({0}) + "a" + control({1 << 5, 1}), 4), "!2");  // before the beginning
  EXPECT_EQ(unpacked(control({0}) + "a" + control({1 << 5}), 4), "!2");     // no distance
  EXPECT_EQ(unpacked(control({0}) + "a" + control({7 << 5, 255}), 300),
            "!2");  // no distance behind the length
  EXPECT_EQ(unpacked(control({0}) + "a" + control({7 << 5, 255, 0}), 100), "!2");
  EXPECT_EQ(unpacked(control({4}) + "verge", 6), "!6");  // too little in the end
}

RC_GTEST_PROP(Lzf, AnyBytesAreSafe, (const std::vector<std::uint8_t>& packed)) {
  std::vector<std::byte> out(*rc::gen::inRange<std::size_t>(0, 600));
  const auto fault = unpack_lzf(std::as_bytes(std::span(packed)), out);
  RC_ASSERT(fault.value_or(0) <= packed.size());
}

}  // namespace verge::io
