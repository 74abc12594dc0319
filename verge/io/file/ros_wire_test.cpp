// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/io/file/ros_wire.hpp"

#include <string>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "verge/io/file/test_bags.hpp"
#include "verge/io/test_files.hpp"

namespace verge::io {
namespace {

using testing::bytes_of;
using testing::WireWriter;

constexpr auto kWires = {Wire::kRos1, Wire::kCdr};

}  // namespace

TEST(RosWire, CdrAlignsEachNumberToItsSizeBehindTheHeader) {
  // Header, u8 at 0, gap to 4, u32, u8 at 8, gap to 16, f64.
  const std::string message = std::string("\0\1\0\0", 4) + "\x05" + std::string(3, 'g') + "\x01\x02\x03\x04" +
                              "\x06" + std::string(7, 'g') + std::string("\0\0\0\0\0\0\xF8\x3F", 8);
  MessageReader reader(Wire::kCdr, bytes_of(message));
  EXPECT_EQ(reader.number<std::uint8_t>(), 5U);
  EXPECT_EQ(reader.number<std::uint32_t>(), 0x04030201U);
  EXPECT_EQ(reader.number<std::uint8_t>(), 6U);
  EXPECT_EQ(reader.number<double>(), 1.5);
  EXPECT_EQ(reader.offset(), message.size());
  EXPECT_FALSE(reader.fault());
}

TEST(RosWire, Ros1HasNoGapsAndNoZeroBehindTexts) {
  const std::string message = std::string("\x05\x01\x02\x03\x04\x03\0\0\0abc", 12);
  MessageReader reader(Wire::kRos1, bytes_of(message));
  EXPECT_EQ(reader.number<std::uint8_t>(), 5U);
  EXPECT_EQ(reader.number<std::uint32_t>(), 0x04030201U);
  EXPECT_EQ(reader.text(), "abc");
  EXPECT_FALSE(reader.fault());
}

TEST(RosWire, TheHeaderOfCdrSaysTheByteOrder) {
  const std::string message = std::string("\0\0\0\0\x01\x02\x03\x04", 8);
  MessageReader reader(Wire::kCdr, bytes_of(message));
  EXPECT_EQ(reader.number<std::uint32_t>(), 0x01020304U);
}

TEST(RosWire, OtherEncodingsOfDdsAreNamed) {
  for (const char encoding : {'\2', '\3', '\6', '\7', '\x0A'}) {
    const std::string message = std::string("\0", 1) + encoding + std::string(6, '\0');
    const MessageReader reader(Wire::kCdr, bytes_of(message));
    ASSERT_TRUE(reader.fault());
    EXPECT_EQ(reader.fault()->got, "encoding " + std::to_string(int{encoding}));
  }
}

TEST(RosWire, AListThatCannotBeInTheMessageIsRefusedBeforeItIsRead) {
  WireWriter writer(Wire::kRos1);
  writer.number(std::uint32_t{4}).number(std::uint64_t{0}).number(std::uint32_t{0});
  MessageReader reader(Wire::kRos1, bytes_of(writer.bytes()));
  EXPECT_EQ(reader.count(4), 0U);  // four of 4 B do not fit 12 B
  ASSERT_TRUE(reader.fault());
  EXPECT_EQ(reader.fault()->where, "0");
  EXPECT_EQ(reader.fault()->got, "4");
  EXPECT_EQ(reader.fault()->need, "<= 3");
  EXPECT_EQ(reader.number<std::uint32_t>(), 0U);  // the fault stays
  EXPECT_EQ(reader.fault()->where, "0");
}

TEST(RosWire, SecondsAreSignedInRos2Alone) {
  const std::string bytes("\xFF\xFF\xFF\xFF\x01\0\0\0", 8);
  MessageReader ros1(Wire::kRos1, bytes_of(bytes));
  EXPECT_EQ(ros1.time_ns(), 4'294'967'295'000'000'001);
  const std::string cdr = std::string("\0\1\0\0", 4) + bytes;
  MessageReader ros2(Wire::kCdr, bytes_of(cdr));
  EXPECT_EQ(ros2.time_ns(), -999'999'999);
}

RC_GTEST_PROP(RosWire, WhatIsWrittenIsReadAndACutIsAFault,
              (std::uint8_t a, double b, const std::string& c, std::uint16_t d)) {
  for (const Wire wire : kWires) {
    for (const bool big : {false, wire == Wire::kCdr}) {
      WireWriter writer(wire, big);
      writer.number(a).number(b).text(c).number(d);
      const auto read = [&](Bytes bytes) {
        MessageReader reader(wire, bytes);
        const auto a2 = reader.number<std::uint8_t>();
        const auto b2 = reader.number<double>();
        const std::string c2(reader.text());
        const bool same =
            a2 == a && b2 == b && reader.number<std::uint16_t>() == d && (c2 == c || c.ends_with('\0'));
        return !reader.fault() && same;
      };
      RC_ASSERT(read(bytes_of(writer.bytes())));
      for (std::size_t n = 0; n < writer.bytes().size(); ++n) {
        const std::string cut = writer.bytes().substr(0, n);
        RC_ASSERT(!read(bytes_of(cut)));
      }
    }
  }
}

RC_GTEST_PROP(RosWire, OurOwnWriterAgreesWithTheTestsWriter,
              (std::uint8_t a, double b, const std::string& c, std::uint32_t d)) {
  CdrWriter ours;
  ours.number(a);
  ours.number(b);
  ours.text(c);
  ours.number(d);
  ours.bytes(c);
  WireWriter other(Wire::kCdr);
  other.number(a).number(b).text(c).number(d).number(static_cast<std::uint32_t>(c.size())).raw(c);
  RC_ASSERT(std::move(ours).take() == other.bytes());
}

}  // namespace verge::io
