// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/io/file/ply.hpp"

#include <algorithm>
#include <cstring>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "verge/io/test_files.hpp"

namespace verge::io {
namespace {

using testing::bytes_of;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

Expected<Decoded> ply(const std::string& bytes) {
  Input input = Input::of(bytes_of(bytes), "a.ply");
  return read_ply(input);
}

/// Values as bytes, of one order or the other.
template <class... T>
std::string packed(bool big_endian, T... values) {
  std::string bytes;
  const auto add = [&](auto value) {
    std::string one(sizeof(value), '\0');
    std::memcpy(one.data(), &value, sizeof(value));
    if (big_endian) std::reverse(one.begin(), one.end());
    bytes += one;
  };
  (add(values), ...);
  return bytes;
}

/// Faces before the vertices, vertices with a list among their properties, something behind.
std::string rich_header(const std::string& format) {
  return "ply\nformat " + format +
         " 1.0\ncomment made by hand\nobj_info nothing\nelement face 2\nproperty list uchar int "
         "vertex_indices\n"
         "element camera 1\nproperty double focal\nelement vertex 2\nproperty float z\nproperty list uchar "
         "short near\n"
         "property double x\nproperty float y\nproperty uchar intensity\nproperty ushort ring\nelement end "
         "1\n"
         "property int nothing\nend_header\n";
}

void expect_rich(const Expected<Decoded>& decoded) {
  ASSERT_TRUE(decoded) << to_string(decoded.error());
  EXPECT_THAT(decoded->cloud.x, ElementsAre(1.5F, -4.0F));
  EXPECT_THAT(decoded->cloud.y, ElementsAre(2.5F, 5.0F));
  EXPECT_THAT(decoded->cloud.z, ElementsAre(3.5F, 6.0F));
  EXPECT_THAT(decoded->cloud.intensity, ElementsAre(200.0F, 0.0F));
  EXPECT_THAT(decoded->cloud.ring, ElementsAre(300, 1));
}

}  // namespace

TEST(Ply, AsciiWithElementsAndListsAroundTheVertices) {
  expect_rich(
      ply(rich_header("ascii") + "3 0 1 2\n4 0 1 2 3\n35.5\n3.5 2 -1 -2 1.5 2.5 200 300\n6 0 -4 5 0 1\n0\n"));
}

TEST(Ply, BinaryInBothOrdersOfBytes) {
  for (const bool big : {false, true}) {
    const std::string data =
        packed(big, std::uint8_t{3}, 0, 1, 2) + packed(big, std::uint8_t{4}, 0, 1, 2, 3) + packed(big, 35.5) +
        packed(big, 3.5F, std::uint8_t{2}, std::int16_t{-1}, std::int16_t{-2}, 1.5, 2.5F, std::uint8_t{200},
               std::uint16_t{300}) +
        packed(big, 6.0F, std::uint8_t{0}, -4.0, 5.0F, std::uint8_t{0}, std::uint16_t{1}) + packed(big, 0);
    expect_rich(ply(rich_header(big ? "binary_big_endian" : "binary_little_endian") + data));
  }
}

TEST(Ply, VerticesOfFixedSizeAreReadInPlace) {
  for (const bool big : {false, true}) {
    const auto decoded =
        ply(std::string("ply\r\nformat ") + (big ? "binary_big_endian" : "binary_little_endian") +
            " 1.0\r\nelement vertex 2\r\nproperty int8 a\r\nproperty float32 x\r\nproperty float64 y\r\n"
            "property int16 z\r\nend_header\r\n" +
            packed(big, std::int8_t{1}, 1.5F, 2.5, std::int16_t{-3}) +
            packed(big, std::int8_t{1}, 4.5F, 5.5, std::int16_t{6}));
    ASSERT_TRUE(decoded) << to_string(decoded.error());
    EXPECT_THAT(decoded->cloud.x, ElementsAre(1.5F, 4.5F));
    EXPECT_THAT(decoded->cloud.y, ElementsAre(2.5F, 5.5F));
    EXPECT_THAT(decoded->cloud.z, ElementsAre(-3.0F, 6.0F));
  }
}

TEST(Ply, EveryErrorSaysWhere) {
  const std::string head = "ply\nformat ascii 1.0\n";
  const std::string vertex = "element vertex 1\nproperty float x\nproperty float y\nproperty float z\n";
  const std::vector<std::pair<std::string, std::string>> cases{
      {head + vertex + "end_header\n1 2 x\n", "8:5"},
      {head + vertex + "end_header\n1 2000\n", "8:7"},
      {head + vertex + "end_header\n1 2 3 4\n", "8:7"},
      {head + "element vertex x\nend_header\n", "3:16"},
      {head + "element vertex 1\nproperty float x\nproperty float y\nend_header\n1 2\n", "3:16"},  // no z
      {head + "element vertex 1\nproperty list float float x\nend_header\n", "4:15"},
      {head + "elemental 1\n", "3:1"},
      {"ply\nformat ascii 2.0\n", "2:14"},
      {"ply\nformat text 1.0\n", "2:8"},
      {head + vertex + "property float x\nend_header\n1 2 3 4\n", "7:16"},
      {head + vertex, "6:17"},  // no end_header
      {"plywood\n", "1:1"}};
  for (const auto& [text, where] : cases) {
    const auto decoded = ply(text);
    ASSERT_FALSE(decoded) << text;
    EXPECT_EQ(decoded.error().where, where) << text << decoded.error().what;
    EXPECT_EQ(decoded.error().code, ErrorCode::kUnusable) << text;
  }
}

TEST(Ply, ACutListSaysTheByteWhereTheFileEnds) {
  const std::string header = rich_header("binary_little_endian");
  const std::string bytes = header + packed(false, std::uint8_t{3}, 0, 1, 2) +
                            packed(false, std::uint8_t{200}, 0, 1) + std::string(100, '\0');
  const auto decoded = ply(bytes);
  ASSERT_FALSE(decoded);
  EXPECT_EQ(decoded.error().where, std::to_string(bytes.size()));
  EXPECT_THAT(decoded.error().what, HasSubstr("element face"));
}

}  // namespace verge::io
