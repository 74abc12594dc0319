// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/io/text.hpp"

#include <clocale>
#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace verge::io {
namespace {

std::vector<std::string> lines_of(std::string_view text) {
  LineReader reader(text);
  std::vector<std::string> lines;
  while (const auto line = reader.next()) lines.emplace_back(*line);
  return lines;
}

TEST(ParseSeconds, KeepsNanoseconds) {
  EXPECT_EQ(parse_seconds("1.036224e-01"), 103'622'400);
  EXPECT_EQ(parse_seconds("1700000000.5"), 1'700'000'000'500'000'000);
  EXPECT_EQ(parse_seconds("1700000000.123456789"), 1'700'000'000'123'456'789);  // more than a double holds
  EXPECT_EQ(parse_seconds("-0.5"), -500'000'000);
  EXPECT_EQ(parse_seconds(" 12.000000001 "), 12'000'000'001);
  EXPECT_EQ(parse_seconds("12"), 12'000'000'000);
  for (const char* text : {"", "x", "1 2", "nan", "1e300", "9e9", "-2e8"})
    EXPECT_FALSE(parse_seconds(text)) << text;
}

}  // namespace

TEST(LineReader, EndsAreLfCrLfOrCr) {
  const std::vector<std::string> want{"a", "", "b c"};
  EXPECT_EQ(lines_of("a\n\nb c\n"), want);
  EXPECT_EQ(lines_of("a\r\n\r\nb c\r\n"), want);
  EXPECT_EQ(lines_of("a\r\rb c\r"), want);
  EXPECT_EQ(lines_of("a\n\nb c"), want);
  EXPECT_TRUE(lines_of("").empty());
}

TEST(LineReader, KnowsItsLineAndWhereTheNextBegins) {
  LineReader reader("ab\ncd", 7);
  EXPECT_EQ(reader.next(), "ab");
  EXPECT_EQ(reader.number(), 7U);
  EXPECT_EQ(reader.offset(), 3U);
  EXPECT_EQ(reader.next(), "cd");
  EXPECT_EQ(reader.number(), 8U);
}

TEST(WordReader, WordsKnowTheirColumn) {
  WordReader words("  x\ty  ", 3);
  const auto x = words.next();
  const auto y = words.next();
  ASSERT_TRUE(x && y);
  EXPECT_EQ(x->text, "x");
  EXPECT_EQ(x->column, 3U);
  EXPECT_EQ(y->column, 5U);
  EXPECT_EQ(y->line, 3U);
  EXPECT_FALSE(words.next());
}

TEST(ParseNumber, TheWholeTextHasToBeTheNumber) {
  EXPECT_EQ(parse_number<double>("1.5"), 1.5);
  EXPECT_EQ(parse_number<double>("-1.5e2"), -150.0);
  EXPECT_EQ(parse_number<double>("+3"), 3.0);
  for (const char* text : {"", "+", "-", "1.5x", "1,5", " 1", "+-1", "0x10", "--1"}) {
    EXPECT_FALSE(parse_number<double>(text)) << text;
  }
  EXPECT_FALSE(parse_number<double>(std::string(65, '1')));
  EXPECT_TRUE(parse_number<double>(std::string(64, '1')));
}

TEST(ParseNumber, IntegersHaveToFit) {
  EXPECT_EQ(parse_number<std::uint64_t>("18446744073709551615"), ~0ULL);
  for (const char* text : {"18446744073709551616", "-1", "1.0", "1e3"}) {
    EXPECT_FALSE(parse_number<std::uint64_t>(text)) << text;
  }
}

TEST(ParseNumber, WhatNoDoubleHoldsIsNotANumberButParses) {
  for (const char* text : {"nan", "NaN", "-nan", "1e400", "-1e400", "1e-400"}) {
    const auto value = parse_number<double>(text);
    ASSERT_TRUE(value) << text;
    EXPECT_TRUE(std::isnan(*value)) << text;
  }
  EXPECT_TRUE(std::isinf(parse_number<double>("inf").value()));
}

TEST(ParseNumber, TheLocaleDoesNotMatter) {
  // Any locale with a decimal comma; where none is installed the fact is not tested.
  const char* set = nullptr;
  for (const char* name : {"de_DE.UTF-8", "de_DE.utf8", "fr_FR.UTF-8"})
    set = set == nullptr ? std::setlocale(LC_ALL, name) : set;
  const auto value = parse_number<double>("1.5");
  const auto comma = parse_number<double>("1,5");
  std::setlocale(LC_ALL, "C");
  if (set == nullptr) GTEST_SKIP() << "no locale with a decimal comma is installed";
  EXPECT_EQ(value, 1.5);
  EXPECT_FALSE(comma);
}

}  // namespace verge::io
