// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/model/json_text.hpp"

#include <array>

#include <gtest/gtest.h>

namespace verge::model {
namespace {

template <class... Steps>
std::size_t column(std::string_view text, Steps... steps) {
  const std::array<JsonStep, sizeof...(Steps)> path{JsonStep(steps)...};
  return column_of(text, path);
}
constexpr std::size_t kFirst = 0;
constexpr std::size_t kSecond = 1;

TEST(ColumnOf, TheWholeValueBeginsAfterSpaceAndByteOrderMark) {
  EXPECT_EQ(column("{}"), 1U);
  EXPECT_EQ(column("  {}"), 3U);
  EXPECT_EQ(column("\xEF\xBB\xBF{}"), 4U);
}

TEST(ColumnOf, MembersAndElementsAreFoundPastNestedOnes) {
  const std::string_view text = R"({"a": [1, {"x": "]}\"", "y": [[], {}]}, 3], "b" : {"c":-4.5}})";
  EXPECT_EQ(text.substr(column(text, "a", kFirst) - 1, 1), "1");
  EXPECT_EQ(text.substr(column(text, "a", kSecond, "x") - 1, 6), R"("]}\"")");
  EXPECT_EQ(text.substr(column(text, "a", std::size_t{2}) - 1, 1), "3");
  EXPECT_EQ(text.substr(column(text, "b", "c") - 1, 4), "-4.5");
}

TEST(ColumnOf, TheLastOfEqualNamesIsMeantHoweverItIsSpelled) {
  const std::string_view text = R"({"a":1,"b":2,"\u0061":3})";
  EXPECT_EQ(text.substr(column(text, "a") - 1, 1), "3");
}

TEST(LineAndColumn, CountsTheLinesBefore) {
  const std::string_view text = "{\n \"a\":\n\n  1}";
  EXPECT_EQ(line_and_column(text, 1, 7), "7:1");
  EXPECT_EQ(line_and_column(text, column(text, "a"), 1), "4:3");
  EXPECT_EQ(line_and_column(text, text.size() + 1, 1), "4:5");
}

TEST(SyntaxFault, TellsTheColumnOfTheLastByteRead) {
  EXPECT_EQ(find_syntax_fault(R"({"a" 1})")->column, 6U);
  EXPECT_EQ(find_syntax_fault(R"({"a":1e999})")->column, 10U);
  EXPECT_EQ(find_syntax_fault(R"({"a":[1,2)")->column, 10U);
  EXPECT_EQ(find_syntax_fault("")->column, 1U);
  EXPECT_EQ(find_syntax_fault("{} x")->column, 4U);
  EXPECT_EQ(find_syntax_fault(R"({"a":NaN})")->column, 6U);
}

TEST(SyntaxFault, TheSentenceHoldsNoPlaceOfItsOwn) {
  EXPECT_EQ(find_syntax_fault(R"({"a":1e999})")->what, "number overflow parsing '1e999'");
  EXPECT_EQ(find_syntax_fault(R"({"a" 1})")->what,
            "syntax error while parsing object separator - unexpected number literal; expected ':'");
}

TEST(SyntaxFault, NoneInJson) {
  EXPECT_FALSE(find_syntax_fault(R"({"a":[1,-2.5e3,null,true,"x"]})").has_value());
  EXPECT_FALSE(find_syntax_fault(std::string(100'000, '[') + std::string(100'000, ']')).has_value());
}

TEST(ValidUtf8, KeepsTextAndReplacesWhatIsNone) {
  EXPECT_EQ(valid_utf8("Straße \"7\"\n"), "Straße \"7\"\n");
  EXPECT_EQ(valid_utf8("a\xFF"
                       "b"),
            "a\xEF\xBF\xBD"
            "b");
}

}  // namespace
}  // namespace verge::model
