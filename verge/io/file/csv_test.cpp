// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/io/file/csv.hpp"

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
using ::testing::IsEmpty;

Expected<Decoded> csv(const std::string& text) {
  Input input = Input::of(bytes_of(text), "a.csv");
  return read_csv(input);
}

void expect_table(const Expected<Decoded>& decoded) {
  ASSERT_TRUE(decoded) << to_string(decoded.error());
  EXPECT_THAT(decoded->cloud.x, ElementsAre(13.4198F, 15.5F));
  EXPECT_THAT(decoded->cloud.y, ElementsAre(9.2232F, -2.0F));
  EXPECT_THAT(decoded->cloud.z, ElementsAre(0.4548F, 0.0F));
  EXPECT_THAT(decoded->cloud.ring, ElementsAre(3, 0));
}

}  // namespace

TEST(Csv, PaperTwosTableWithoutHeader) {
  const auto decoded = csv("33,3,16.2900,13.4198,9.2232,0.4548\n34,0,15.6,15.5,-2,0\n");
  expect_table(decoded);
  EXPECT_THAT(decoded->notes, ElementsAre("table without header: number, level, distance, x, y, z"));
}

TEST(Csv, AHeaderNamesTheColumnsInAnyOrder) {
  expect_table(csv("z,x,Level,y\n0.4548,13.4198,3,9.2232\n0,15.5,0,-2\n"));
  expect_table(csv("\xEF\xBB\xBFx [m];y [m];z [m];ring;who\n13.4198;9.2232;0.4548;3;1\n15.5;-2;0;0;2\n"));
  expect_table(csv("x_m\ty_m\tz_m\tchannel\n13.4198\t9.2232\t0.4548\t3\n15.5\t-2\t0\t0\n"));
}

TEST(Csv, QuotesSpacesBlankLinesAndEveryEndOfLine) {
  expect_table(csv("\"x\", \"y\" , z,ring\n\n \"13.4198\",\"9.2232\" ,  0.4548,3\n15.5,-2,0,0"));
  expect_table(csv("x,y,z,ring\r\n13.4198,9.2232,0.4548,3\r\n15.5,-2,0,0\r\n"));
  expect_table(csv("x,y,z,ring\r13.4198,9.2232,0.4548,3\r15.5,-2,0,0\r"));
}

TEST(Csv, ThreeColumnsArePositionsAndFourHaveIntensity) {
  EXPECT_THAT(csv("1,2,3\n")->cloud.z, ElementsAre(3.0F));
  const auto decoded = csv("1,2,3,4\n");
  EXPECT_THAT(decoded->cloud.intensity, ElementsAre(4.0F));
  EXPECT_THAT(decoded->cloud.ring, IsEmpty());
}

TEST(Csv, EveryErrorSaysWhere) {
  const std::vector<std::pair<std::string, std::string>> cases{
      {"x,y,z\n1,2,3\n1,2,a\n", "3:5"},
      {"x,y,z\n1,2,\n", "2:5"},        // empty cell
      {"x,y,z\n1,2\n", "2:4"},         // too few
      {"x,y,z\n1,2,3,4\n", "2:7"},     // too many
      {"x;y;z\n1;2,5;3\n", "2:3"},     // decimal comma
      {"x,y,z\n1,\"2,3\n", "2:3"},     // quote not closed
      {"x,y,z\n1,\"2\"3,4\n", "2:3"},  // something behind the quote
      {"a,b,c\n1,2,3\n", "1:1"},       // no x, y, z
      {"1,2\n", "1:1"},
      {std::string("x,y,z\n1,2,\0003\n", 14), "2:5"},
      {"x,y,z\n1,2," + std::string(65, '1') + "\n", "2:5"}};
  for (const auto& [text, where] : cases) {
    const auto decoded = csv(text);
    ASSERT_FALSE(decoded) << text;
    EXPECT_EQ(decoded.error().where, where) << text << decoded.error().what;
    EXPECT_EQ(decoded.error().code, ErrorCode::kUnusable) << text;
  }
  EXPECT_THAT(csv("x;y;z\n1;2,5;3\n").error().what, HasSubstr("decimal comma"));
}

TEST(Csv, OnlyAHeaderIsNoPoint) {
  const auto decoded = csv("x,y,z\n");
  ASSERT_FALSE(decoded);
  EXPECT_EQ(decoded.error().code, ErrorCode::kDamaged);
}

TEST(LooksLikeTable, HeaderOrNumbers) {
  for (const char* text : {"1,2,3\n", "number;level;distance;x;y;z\n", "x\ty\tz", "\n\n1;2;3;4"}) {
    EXPECT_TRUE(looks_like_table(text)) << text;
  }
  for (const char* text : {"", "1,2\n", "1 2 3\n", "a,b,c\n", "hello\n", "1,2,3,4,5\n", "x,y\n"}) {
    EXPECT_FALSE(looks_like_table(text)) << text;
  }
}

}  // namespace verge::io
