// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/io/file/pcd.hpp"

#include <cmath>
#include <cstring>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "verge/io/file/pcd_header.hpp"
#include "verge/io/source.hpp"
#include "verge/io/test_files.hpp"
#include "verge/scan/organise.hpp"

namespace verge::io {
namespace {

using testing::bytes_of;
using ::testing::DoubleNear;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using testing::TemporaryFolder;

Expected<Decoded> pcd(const std::string& bytes) {
  Input input = Input::of(bytes_of(bytes), "a.pcd");
  return read_pcd(input);
}

template <class... T>
std::string packed(T... values) {
  std::string bytes;
  const auto add = [&](auto value) {
    std::string one(sizeof(value), '\0');
    std::memcpy(one.data(), &value, sizeof(value));
    bytes += one;
  };
  (add(values), ...);
  return bytes;
}

/// LZF without any compression: literals only.
std::string literals(const std::string& bytes) {
  std::string out;
  for (std::size_t i = 0; i < bytes.size(); i += 32) {
    const std::string chunk = bytes.substr(i, 32);
    out += static_cast<char>(chunk.size() - 1) + chunk;
  }
  return out;
}

}  // namespace

TEST(Pcd, AsciiFieldsOfAnyOrderAndType) {
  const auto decoded = pcd(
      "# .PCD v0.7 - Point Cloud Data file format\nVERSION 0.7\nFIELDS ring z intensity y x\nSIZE 2 4 4 8 4\n"
      "TYPE U F F F F\nCOUNT 1 1 1 1 1\nWIDTH 2\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS 2\nDATA ascii\n"
      "7 -1.5 12 2.25 10\n\n3 0.5 13 -2e0 +11\n");
  ASSERT_TRUE(decoded) << to_string(decoded.error());
  EXPECT_THAT(decoded->cloud.x, ElementsAre(10.0F, 11.0F));
  EXPECT_THAT(decoded->cloud.y, ElementsAre(2.25F, -2.0F));
  EXPECT_THAT(decoded->cloud.z, ElementsAre(-1.5F, 0.5F));
  EXPECT_THAT(decoded->cloud.intensity, ElementsAre(12.0F, 13.0F));
  EXPECT_THAT(decoded->cloud.ring, ElementsAre(7, 3));
  EXPECT_THAT(decoded->notes, IsEmpty());
}

TEST(Pcd, BinaryFieldsStandPointByPointWithPadding) {
  const auto decoded =
      pcd("VERSION 0.7\nFIELDS x _ y z channel _ timestamp\nSIZE 4 1 8 4 1 2 8\nTYPE F U F F U U F\n"
          "COUNT 1 3 1 1 1 2 1\nWIDTH 2\nHEIGHT 1\nPOINTS 2\nDATA binary\n" +
          packed(1.0F, 'p', 'a', 'd', 2.0, 3.0F, std::uint8_t{9}, 0, 1.7e9) +
          packed(4.0F, 'p', 'a', 'd', 5.0, 6.0F, std::uint8_t{8}, 0, 1.7e9 + 0.0625));
  ASSERT_TRUE(decoded) << to_string(decoded.error());
  EXPECT_THAT(decoded->cloud.x, ElementsAre(1.0F, 4.0F));
  EXPECT_THAT(decoded->cloud.y, ElementsAre(2.0F, 5.0F));
  EXPECT_THAT(decoded->cloud.z, ElementsAre(3.0F, 6.0F));
  EXPECT_THAT(decoded->cloud.ring, ElementsAre(9, 8));
  EXPECT_EQ(decoded->stamp_ns, 1'700'000'000'000'000'000);
  EXPECT_THAT(decoded->cloud.time_s, ElementsAre(0.0, DoubleNear(0.0625, 1e-12)));
}

TEST(Pcd, CompressedFieldsStandFieldByField) {
  const std::string columns = packed(1.0F, 2.0F, 3.0F) + packed(4.0F, 5.0F, 6.0F) + std::string(6, '_') +
                              packed(7.0F, 8.0F, 9.0F) +
                              packed(std::uint16_t{0}, std::uint16_t{1}, std::uint16_t{2});
  const std::string lzf = literals(columns);
  const auto decoded =
      pcd("VERSION 0.7\nFIELDS x y _ z ring\nSIZE 4 4 1 4 2\nTYPE F F U F U\nCOUNT 1 1 2 1 1\nWIDTH 3\n"
          "HEIGHT 1\nPOINTS 3\nDATA binary_compressed\n" +
          packed(static_cast<std::uint32_t>(lzf.size()), static_cast<std::uint32_t>(columns.size())) + lzf +
          "what stands behind is left alone");
  ASSERT_TRUE(decoded) << to_string(decoded.error());
  EXPECT_THAT(decoded->cloud.x, ElementsAre(1.0F, 2.0F, 3.0F));
  EXPECT_THAT(decoded->cloud.y, ElementsAre(4.0F, 5.0F, 6.0F));
  EXPECT_THAT(decoded->cloud.z, ElementsAre(7.0F, 8.0F, 9.0F));
  EXPECT_THAT(decoded->cloud.ring, ElementsAre(0, 1, 2));
}

TEST(Pcd, ColumnsCountAndPointsMayBeMissing) {
  const auto decoded =
      pcd("COLUMNS x y z\nSIZE 4 4 4\nTYPE F F F\nWIDTH 2\nHEIGHT 1\nDATA ascii\n1 2 3\n4 5 6");
  ASSERT_TRUE(decoded) << to_string(decoded.error());
  EXPECT_THAT(decoded->cloud.z, ElementsAre(3.0F, 6.0F));
  const auto points = pcd("FIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nPOINTS 1\nDATA ascii\n1 2 3\n");
  ASSERT_TRUE(points) << to_string(points.error());
  EXPECT_EQ(points->cloud.x.size(), 1U);
}

TEST(Pcd, AViewpointIsNotAppliedAndSaid) {
  const auto decoded =
      pcd("FIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nVIEWPOINT 1 2 3 0 0 0 1\nPOINTS 1\nDATA ascii\n1 2 3\n");
  ASSERT_TRUE(decoded);
  EXPECT_THAT(decoded->cloud.x, ElementsAre(1.0F));
  EXPECT_THAT(decoded->notes, ElementsAre(HasSubstr("VIEWPOINT")));
}

TEST(Pcd, RowsBehindTheLastPointAreSaid) {
  const auto decoded = pcd("FIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nPOINTS 1\nDATA ascii\n1 2 3\n4 5 6\n");
  ASSERT_TRUE(decoded);
  EXPECT_EQ(decoded->cloud.x.size(), 1U);
  EXPECT_THAT(decoded->notes, ElementsAre(HasSubstr("line 7")));
}

TEST(Pcd, EveryErrorSaysWhere) {
  const std::string head = "FIELDS x y z\nSIZE 4 4 4\nTYPE F F F\n";
  const std::vector<std::pair<std::string, std::string>> cases{
      {head + "POINTS 2\nDATA ascii\n1 2 3\n4 5 x\n", "7:5"},   // no number
      {head + "POINTS 2\nDATA ascii\n1 2 3\n4 5000\n", "7:7"},  // too short
      {head + "POINTS 1\nDATA ascii\n1 2 3 4\n", "6:7"},        // too long
      {head + "POINTS 2\nDATA ascii\n1 2 3\n      \n", "7:1"},  // one row is missing
      {head + "HEIGHT -1\nPOINTS 1\nDATA ascii\n1 2 3\n", "4:8"},
      {head + "POINTS 1\nDATA asci\n1 2 3\n", "5:6"},
      {head + "POINTS 3\nDATA binary\n" + packed(1.0F, 2.0F, 3.0F), "4:1"},
      {"FIELDS x y z\nSIZE 4 4\nTYPE F F F\nPOINTS 1\nDATA ascii\n1 2 3\n", "2:1"},
      {"FIELDS x y z\nTYPE F F F\nPOINTS 1\nDATA ascii\n1 2 3\n", "4:11"},  // SIZE is missing
      {head + "POINTS 1\nPOINTS 1\nDATA ascii\n1 2 3\n", "5:1"},
      {head + "VIEWPOINT 0 0 0 1 0 0 a\nPOINTS 1\nDATA ascii\n1 2 3\n", "4:23"}};
  for (const auto& [text, where] : cases) {
    const auto decoded = pcd(text);
    ASSERT_FALSE(decoded) << text;
    EXPECT_EQ(decoded.error().where, where) << text << decoded.error().what;
    EXPECT_EQ(decoded.error().code, ErrorCode::kUnusable) << text;
  }
}

TEST(Pcd, ALongCommentIsNoTrouble) {
  const auto decoded = pcd("# .PCD " + std::string(1U << 20U, 'c') +
                           "\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nPOINTS 1\n"
                           "DATA ascii\n1 2 3\n");
  ASSERT_TRUE(decoded) << to_string(decoded.error());
  EXPECT_EQ(decoded->cloud.x.size(), 1U);
}

TEST(Pcd, WhatIsWrittenComesBackBitForBit) {
  const TemporaryFolder folder;
  Cloud cloud;
  for (int i = 0; i < 300; ++i) {
    const double azimuth = 0.021 * i;
    cloud.x.push_back(static_cast<float>(10 * std::cos(azimuth)));
    cloud.y.push_back(static_cast<float>(10 * std::sin(azimuth)));
    cloud.z.push_back(static_cast<float>(i % 3 - 1));
    cloud.intensity.push_back(static_cast<float>(i));
    cloud.ring.push_back(i % 3);
    cloud.time_s.push_back(i * 1e-4);
  }
  const Scan scan = organise(cloud).scan;
  const auto path = folder.path() / "a.pcd";
  ASSERT_TRUE(write_pcd(path, scan));
  const auto source = open(path);
  ASSERT_TRUE(source) << to_string(source.error());
  EXPECT_EQ((*source)->info().format, Format::kPcd);
  const auto back = (*source)->next();
  ASSERT_TRUE(back && *back);
  EXPECT_EQ((*back)->x, scan.x);
  EXPECT_EQ((*back)->y, scan.y);
  EXPECT_EQ((*back)->z, scan.z);
  EXPECT_EQ((*back)->intensity, scan.intensity);
  EXPECT_EQ((*back)->ring_begin, scan.ring_begin);
  EXPECT_EQ((*back)->time_offset_ns, scan.time_offset_ns);
}

}  // namespace verge::io
