// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/core/error.hpp"

#include <gtest/gtest.h>

namespace verge {
namespace {

TEST(ErrorLine, SaysFilePlaceWhatGotAndNeed) {
  const Error error{ErrorCode::kDamaged,          "drive.pcap", "1048",
                    "record length exceeds file", "4294967295", "<= 262144"};
  EXPECT_EQ(to_string(error), "drive.pcap:1048: record length exceeds file (got 4294967295, need <= 262144)");
}

TEST(ErrorLine, LeavesOutWhatIsNotKnown) {
  EXPECT_EQ(to_string({ErrorCode::kCannotOpen, "a.pcd", "", "no such file", "", ""}), "a.pcd: no such file");
  EXPECT_EQ(to_string({ErrorCode::kUsage, "", "", "two formats fit", "2", ""}), "two formats fit (got 2)");
  EXPECT_EQ(to_string({ErrorCode::kUsage, "", "", "two formats fit", "", "1"}), "two formats fit (need 1)");
}

TEST(ErrorLine, EscapesControlBytesSoThatOneErrorIsOneLine) {
  const std::string line = to_string({ErrorCode::kCannotOpen, "a\nb\x1b[31m.pcd", "", "no\tfile", "", ""});
  EXPECT_EQ(line, "a\\x0Ab\\x1B[31m.pcd: no\\x09file");
}

TEST(ErrorLine, LeavesTextOfAnyLanguageAsItIs) {
  const std::string text =
      "Stra\xC3\x9F"
      "e \xE9\x81\x93 \xED\x9F\xBF \xF0\x9F\x9B\xA3 \xF4\x8F\xBF\xBF";
  EXPECT_EQ(escape_control_bytes(text), text);
}

TEST(ErrorLine, EscapesBytesThatAreNoUtf8) {
  EXPECT_EQ(escape_control_bytes("a\xFF\xFE"
                                 "b"),
            "a\\xFF\\xFE"
            "b");
  EXPECT_EQ(escape_control_bytes("\xC3(\x80"), "\\xC3(\\x80");  // without its second byte, without its first
  EXPECT_EQ(escape_control_bytes("\xE9\x81"), "\\xE9\\x81");    // cut
  EXPECT_EQ(escape_control_bytes("\xC0\xAF"), "\\xC0\\xAF");    // '/' in two bytes
  EXPECT_EQ(escape_control_bytes("\xE0\x80\xAF"), "\\xE0\\x80\\xAF");           // in three
  EXPECT_EQ(escape_control_bytes("\xF0\x8F\xBF\xBF"), "\\xF0\\x8F\\xBF\\xBF");  // U+FFFF in four
  EXPECT_EQ(escape_control_bytes("\xED\xA0\x80"), "\\xED\\xA0\\x80");           // a surrogate
  EXPECT_EQ(escape_control_bytes("\xF4\x90\x80\x80"), "\\xF4\\x90\\x80\\x80");  // beyond U+10FFFF
  EXPECT_EQ(escape_control_bytes("\xC2\x9B"
                                 "31m\xC2\xA0"),
            "\\xC2\\x9B"
            "31m\xC2\xA0");  // CSI, in one character
}

TEST(ErrorLine, IsShortenedBetweenCharactersAndEscapes) {
  for (std::size_t shift = 0; shift < 8; ++shift) {
    for (const std::string unit : {"\xE9\x81\x93", "\x01", "\xFF", "\xF0\x9F\x9B\xA3"}) {
      std::string what(shift, 'w');
      for (int i = 0; i < 300; ++i) what += unit;
      const std::string line = to_string({ErrorCode::kDamaged, what, "7", what, "", ""});
      EXPECT_LE(line.size(), 280U);
      EXPECT_GE(line.size(), 260U);
      std::string once = line;
      for (std::size_t at = 0; (at = once.find('\\', at)) != std::string::npos; at += 4) {
        const std::string escape = once.substr(at, 4);
        ASSERT_TRUE(escape == "\\x01" || escape == "\\xFF") << line;
        once.replace(at, 4, "....");
      }
      EXPECT_EQ(escape_control_bytes(once), once);
    }
  }
}

TEST(ErrorLine, IsNeverLongerThanALine) {
  const Error error{ErrorCode::kCannotOpen, std::string(4096, 'p'), "12", std::string(900, 'w'), "1", "2"};
  EXPECT_LE(to_string(error).size(), 280U);
  EXPECT_NE(to_string(error).find(":12: "), std::string::npos);
}

}  // namespace
}  // namespace verge
