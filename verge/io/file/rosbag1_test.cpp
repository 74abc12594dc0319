// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/io/file/rosbag1.hpp"

#include <string>
#include <vector>

#include <bzlib.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "verge/io/file/test_bags.hpp"
#include "verge/io/test_files.hpp"

namespace verge::io {
namespace {

using testing::bag_field;
using testing::bag_record;
using testing::bytes_of;
using ::testing::HasSubstr;
using testing::le;
using testing::Outcome;
using testing::read_through;
using testing::rosbag1_of;
using testing::TestMessage;

constexpr std::size_t kFirstRecord = 13;
constexpr std::size_t kFirstChunk = 13 + 4096;

Outcome run(const std::string& bytes) {
  return read_through(open_rosbag1(Input::of(bytes_of(bytes), "a.bag"), {}));
}

std::vector<TestMessage> clouds(std::uint32_t n) { return testing::cloud_messages(n, Wire::kRos1); }

}  // namespace

TEST(Rosbag1, OtherVersionsAreNamed) {
  const Outcome got = run("#ROSBAG V1.2\n...");
  ASSERT_EQ(got.errors.size(), 1U);
  EXPECT_EQ(got.errors[0].code, ErrorCode::kUnusable);
  EXPECT_EQ(got.errors[0].got, "#ROSBAG V1.2");
}

TEST(Rosbag1, R1ABagThatWasNotClosedGivesItsScansAndAnError) {
  for (const char* compression : {"none", "lz4", "bz2"}) {
    const std::string bytes = rosbag1_of(clouds(5), {.compression = compression, .index = false});
    const Outcome got = run(bytes);
    EXPECT_EQ(got.scans.size(), 5U);
    ASSERT_EQ(got.errors.size(), 1U);
    EXPECT_EQ(got.errors[0].code, ErrorCode::kDamaged);
    EXPECT_THAT(got.errors[0].what, HasSubstr("not closed"));
  }
}

TEST(Rosbag1, R2AChunkThatIsCutEndsTheBag) {
  const std::string whole = rosbag1_of(clouds(6));
  const std::size_t third = whole.find("op=\x05", whole.find("op=\x05", whole.find("op=\x05") + 1) + 1) - 8;
  const Outcome got = run(whole.substr(0, third + 100));
  EXPECT_EQ(got.scans.size(), 4U);
  ASSERT_EQ(got.errors.size(), 1U);
  EXPECT_EQ(got.errors[0].where, std::to_string(third));
  EXPECT_THAT(got.errors[0].what, HasSubstr("longer than what is left"));
}

TEST(Rosbag1, R2ABagThatIsCutBetweenChunksIsNotTakenForWhole) {
  const std::string whole = rosbag1_of(clouds(6));
  const std::size_t third = whole.find("op=\x05", whole.find("op=\x05", whole.find("op=\x05") + 1) + 1) - 8;
  const Outcome got = run(whole.substr(0, third));
  EXPECT_EQ(got.scans.size(), 4U);
  ASSERT_EQ(got.errors.size(), 1U);
  EXPECT_THAT(got.errors[0].what, HasSubstr("ends before its index"));
}

TEST(Rosbag1, R2ADamagedChunkIsLeftOutAndTheNextIsRead) {
  for (const char* compression : {"lz4", "bz2"}) {
    std::string bytes = rosbag1_of(clouds(6), {.compression = compression});
    const std::size_t second = bytes.find("op=\x05", bytes.find("op=\x05") + 1);
    bytes[second + 80] = static_cast<char>(bytes[second + 80] ^ 0x55);
    const Outcome got = run(bytes);
    EXPECT_EQ(got.scans.size(), 4U) << compression;
    ASSERT_EQ(got.errors.size(), 1U);
    EXPECT_THAT(got.errors[0].what, HasSubstr("chunk is damaged"));
  }
}

TEST(Rosbag1, R3BombsAreRefused) {
  std::string zeros(1U << 22U, '\0');
  std::string packed(100'000, '\0');
  auto size = static_cast<unsigned>(packed.size());
  BZ2_bzBuffToBuffCompress(packed.data(), &size, zeros.data(), static_cast<unsigned>(zeros.size()), 9, 0, 0);
  packed.resize(size);
  const std::string lz4 = pack(Packing::kLz4, bytes_of(zeros));
  struct Case {
    const char* compression;
    std::string packed;
    std::uint32_t unpacked;
    ErrorCode code;
  };
  const std::vector<Case> cases{{"bz2", packed, 1U << 22U, ErrorCode::kLimit},     // more than 1024 times
                                {"bz2", packed, 100, ErrorCode::kUnusable},        // more than it tells
                                {"lz4", lz4, (1U << 30U) + 1, ErrorCode::kLimit},  // more than 1 GiB
                                {"lz4", lz4, 1000, ErrorCode::kUnusable},
                                {"zip", "", 0, ErrorCode::kUnusable}};
  const std::string head = rosbag1_of({}, {.index = false});
  for (const Case& c : cases) {
    const std::string bytes =
        head + bag_record(bag_field("op", "\x05") + bag_field("compression", c.compression) +
                              bag_field("size", le(c.unpacked)),
                          c.packed);
    const auto bag = open_rosbag1_bag(Input::of(bytes_of(bytes), "a.bag"));
    ASSERT_FALSE(bag);  // it is all that the bag holds
    EXPECT_EQ(bag.error().code, c.code) << c.compression << c.unpacked;
    EXPECT_THAT(bag.error().what, HasSubstr("chunk"));
  }
}

TEST(Rosbag1, R4AnIndexThatPointsOutsideIsNotNeeded) {
  const std::string whole = rosbag1_of(clouds(3));
  const std::size_t index = whole.find("index_pos=") + 10;
  for (const std::uint64_t at :
       {std::uint64_t{14}, std::uint64_t{kFirstChunk}, std::uint64_t{whole.size() - 5}}) {
    std::string bytes = whole;
    bytes.replace(index, 8, le(at));
    const Outcome got = run(bytes);
    EXPECT_EQ(got.scans.size(), 3U) << at;
    EXPECT_EQ(got.errors.size(), 0U) << at;
  }
  std::string bytes = whole;
  bytes.replace(index, 8, le(~std::uint64_t{0}));  // behind the end: as if cut
  const Outcome got = run(bytes);
  EXPECT_EQ(got.scans.size(), 3U);
  EXPECT_EQ(got.errors.size(), 1U);
}

TEST(Rosbag1, R5ARecordWithoutOperationIsSteppedOver) {
  const std::string whole = rosbag1_of(clouds(2), {.index = false});
  const std::string stray = bag_record(bag_field("conn", le(0)), "data");
  const Outcome got = run(whole.substr(0, kFirstChunk) + stray + whole.substr(kFirstChunk));
  EXPECT_EQ(got.scans.size(), 2U);
  ASSERT_EQ(got.errors.size(), 2U);  // this, and the bag was not closed
  EXPECT_EQ(got.errors[0].where, std::to_string(kFirstChunk));
  EXPECT_THAT(got.errors[0].what, HasSubstr("no operation"));
}

TEST(Rosbag1, AHeaderLongerThanOneMebibyteIsRefused) {
  std::string bytes = rosbag1_of(clouds(2), {.index = false}) + std::string(2U << 20U, 'x');
  const std::size_t end = bytes.size() - (2U << 20U);
  bytes.replace(end, 4, le((1U << 20U) + 1));
  const Outcome got = run(bytes);
  EXPECT_EQ(got.scans.size(), 2U);
  ASSERT_EQ(got.errors.size(), 1U);
  EXPECT_EQ(got.errors[0].where, std::to_string(end));
  EXPECT_EQ(got.errors[0].need, "<= 1048576 B");
}

TEST(Rosbag1, WithoutItsOwnHeaderItIsNoBag) {
  std::string bytes = rosbag1_of(clouds(1));
  bytes[bytes.find("op=\x03") + 3] = '\x04';
  const Outcome got = run(bytes);
  ASSERT_EQ(got.errors.size(), 1U);
  EXPECT_EQ(got.errors[0].code, ErrorCode::kUnusable);
  EXPECT_EQ(got.errors[0].where, std::to_string(kFirstRecord));
}

TEST(Rosbag1, R7AnotherDefinitionUnderTheSameNameIsNotRead) {
  const Outcome got = run(rosbag1_of(clouds(3), {.md5 = "00000000000000000000000000000000"}));
  EXPECT_EQ(got.scans.size(), 0U);
  ASSERT_EQ(got.errors.size(), 1U);
  EXPECT_EQ(got.errors[0].code, ErrorCode::kUnusable);
  EXPECT_THAT(got.errors[0].got, HasSubstr("another definition, MD5 00000000"));
}

TEST(Rosbag1, R8AMessageOfAnUnknownConnectionIsAnError) {
  std::string bytes = rosbag1_of(clouds(3));
  const std::size_t message = bytes.find("op=\x02", bytes.find("op=\x02") + 1);
  bytes.replace(bytes.find("conn=", message) + 5, 4, le(77));
  const Outcome got = run(bytes);
  EXPECT_EQ(got.scans.size(), 2U);
  ASSERT_EQ(got.errors.size(), 1U);
  EXPECT_EQ(got.errors[0].got, "77");
  EXPECT_THAT(got.errors[0].where, HasSubstr("+"));  // offset of the chunk + offset in it
}

}  // namespace verge::io
