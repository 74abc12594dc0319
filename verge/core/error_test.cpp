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

TEST(ErrorLine, IsNeverLongerThanALine) {
  const Error error{ErrorCode::kCannotOpen, std::string(4096, 'p'), "12", std::string(900, 'w'), "1", "2"};
  EXPECT_LE(to_string(error).size(), 280U);
  EXPECT_NE(to_string(error).find(":12: "), std::string::npos);
}

}  // namespace
}  // namespace verge
