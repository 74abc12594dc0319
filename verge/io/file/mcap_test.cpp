// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/io/file/mcap.hpp"

#include <cmath>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "verge/io/file/mcap_writer.hpp"
#include "verge/io/file/test_bags.hpp"
#include "verge/io/test_files.hpp"
#include "verge/scan/organise.hpp"

namespace verge::io {
namespace {

using testing::bytes_of;
using testing::cloud_messages;
using ::testing::HasSubstr;
using testing::le;
using testing::mcap_of;
using testing::mcap_record;
using testing::Outcome;
using testing::read_through;
using testing::TemporaryFolder;

constexpr std::int64_t kBegin = 1'700'000'000'000'000'000;

Outcome run(const std::string& bytes) {
  return read_through(open_mcap(Input::of(bytes_of(bytes), "a.mcap"), {}));
}

std::string text_of(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

std::size_t nth(const std::string& text, const std::string& what, int n) {
  std::size_t at = text.find(what);
  while (--n > 0) at = text.find(what, at + 1);
  return at;
}

Scan some_scan(int points, std::int64_t stamp_ns) {
  Cloud cloud;
  for (int i = 0; i < points; ++i) {
    cloud.x.push_back(static_cast<float>(10 * std::cos(0.02 * i)));
    cloud.y.push_back(static_cast<float>(10 * std::sin(0.02 * i)));
    cloud.z.push_back(static_cast<float>(i % 4 - 2));
    cloud.intensity.push_back(static_cast<float>(i % 100));
    cloud.ring.push_back(i % 4);
    cloud.time_s.push_back(1e-6 * i);
  }
  Scan scan = organise(std::move(cloud)).scan;
  scan.stamp_ns = stamp_ns;
  scan.frame_id = "lidar";
  return scan;
}

void write_all(const std::filesystem::path& path, const std::vector<Scan>& scans,
               const McapWriterOptions& options = {}) {
  auto writer = McapWriter::create(path, options);
  ASSERT_TRUE(writer) << to_string(writer.error());
  for (const Scan& scan : scans) ASSERT_TRUE(writer->add(scan));
  ASSERT_TRUE(writer->finish());
}

/// The scans of a file that we wrote, as they were before.
std::vector<Scan> read_all(const std::string& bytes) {
  Outcome got = run(bytes);
  EXPECT_TRUE(got.errors.empty()) << to_string(got.errors.front());
  std::vector<Scan> out;
  for (Decoded& decoded : got.scans) {
    Scan scan = organise(std::move(decoded.cloud)).scan;
    scan.stamp_ns = decoded.stamp_ns;
    scan.frame_id = decoded.frame_id;
    scan.T_world_sensor = decoded.T_world_sensor;
    scan.motion = decoded.motion;
    out.push_back(std::move(scan));
  }
  return out;
}

}  // namespace

TEST(Mcap, NoMcapIsSaid) {
  const auto got = run("#ROSBAG V2.0\n");
  ASSERT_EQ(got.errors.size(), 1U);
  EXPECT_EQ(got.errors[0].code, ErrorCode::kUnusable);
}

TEST(Mcap, R1ARecorderThatWasKilledLeavesItsScansAndAnError) {
  for (const std::size_t chunk : {0U, 2U}) {
    const std::string bytes = mcap_of(cloud_messages(6), {.messages_per_chunk = chunk, .footer = false});
    const Outcome got = run(bytes);
    EXPECT_EQ(got.scans.size(), 6U);
    ASSERT_EQ(got.errors.size(), 1U);
    EXPECT_EQ(got.errors[0].code, ErrorCode::kDamaged);
    EXPECT_EQ(got.errors[0].where, std::to_string(bytes.size()));
    EXPECT_THAT(got.errors[0].what, HasSubstr("not closed"));
  }
}

TEST(Mcap, R2AChunkThatIsCutEndsTheFile) {
  const std::string whole = mcap_of(cloud_messages(6));
  const std::size_t third = nth(whole, "zstd", 3);
  const Outcome got = run(whole.substr(0, third + 30));
  EXPECT_EQ(got.scans.size(), 4U);
  ASSERT_EQ(got.errors.size(), 1U);
  // 8 + 8 + 8 + 4 + 4 bytes of the chunk stand before the name of its compression, 9 of its head before them.
  EXPECT_EQ(got.errors[0].where, std::to_string(third - 32 - 9));
  EXPECT_THAT(got.errors[0].what, HasSubstr("longer than what is left"));
}

TEST(Mcap, R2ADamagedChunkIsLeftOutAndTheNextIsRead) {
  for (const Packing packing : {Packing::kNone, Packing::kLz4, Packing::kZstd}) {
    // The summary knows the channel, which is defined in the first chunk.
    std::string bytes = mcap_of(cloud_messages(6), {.packing = packing});
    const std::string name = packing == Packing::kLz4 ? "lz4" : "zstd";
    const std::size_t inside =
        packing == Packing::kNone ? bytes.find("sensor_msgs") : nth(bytes, name, 2) + 40;
    bytes[inside] = static_cast<char>(bytes[inside] ^ 0x55);
    const Outcome got = run(bytes);
    EXPECT_EQ(got.scans.size(), 4U) << name;
    ASSERT_EQ(got.errors.size(), 1U) << name;
    EXPECT_THAT(got.errors[0].what, HasSubstr("chunk is damaged"));
  }
}

TEST(Mcap, R3BombsAreRefusedBeforeTheyAreUnpacked) {
  const std::string magic("\x89MCAP0\r\n", 8);
  const auto chunk = [](std::uint64_t unpacked, const std::string& packed) {
    return mcap_record(0x06, std::string(16, '\0') + le(unpacked) + le(0U) + le(4U) + "zstd" +
                                 le(std::uint64_t{packed.size()}) + packed);
  };
  const std::string zeros = pack(Packing::kZstd, bytes_of(std::string(1U << 20U, '\0')));
  struct Case {
    std::uint64_t unpacked;
    std::string packed;
    ErrorCode code;
  };
  const std::vector<Case> cases{{(1ULL << 30U) + 1, zeros, ErrorCode::kLimit},
                                {0xFFFF'FFFF'FFFF'FFFF, zeros, ErrorCode::kLimit},
                                {1U << 20U, zeros, ErrorCode::kLimit},  // more than 1024 times
                                {1000, zeros, ErrorCode::kUnusable}};   // more than it tells
  for (const Case& c : cases) {
    const std::string end = mcap_of({}, {});  // a footer
    const std::string bytes = magic + chunk(c.unpacked, c.packed) + end.substr(8);
    const auto bag = open_mcap_bag(Input::of(bytes_of(bytes), "a.mcap"));
    ASSERT_FALSE(bag);  // it is all that the file holds
    EXPECT_EQ(bag.error().code, c.code) << c.unpacked << bag.error().what;
  }
}

TEST(Mcap, R4ASummaryThatPointsOutsideIsNotNeeded) {
  const std::string whole = mcap_of(cloud_messages(3));
  const std::size_t footer = whole.size() - 8 - 20;
  for (const std::uint64_t start : {std::uint64_t{1}, std::uint64_t{whole.size()}, ~std::uint64_t{0}}) {
    std::string bytes = whole;
    bytes.replace(footer, 8, le(start));
    const Outcome got = run(bytes);
    EXPECT_EQ(got.scans.size(), 3U);
    EXPECT_EQ(got.errors.size(), 0U);
  }
}

TEST(Mcap, R8AMessageOfAChannelThatNobodyDefined) {
  const std::string magic("\x89MCAP0\r\n", 8);
  const std::string whole = mcap_of(cloud_messages(2), {.messages_per_chunk = 0, .summary = false});
  const std::string stray = mcap_record(0x05, le(std::uint16_t{99}) + std::string(20, '\0') + "data");
  const Outcome got = run(magic + stray + whole.substr(8));
  EXPECT_EQ(got.scans.size(), 2U);
  ASSERT_EQ(got.errors.size(), 1U);
  EXPECT_EQ(got.errors[0].where, "17");
  EXPECT_EQ(got.errors[0].got, "99");
}

TEST(Mcap, RecordsOfLaterVersionsAreSteppedOver) {
  const std::string whole = mcap_of(cloud_messages(2), {.messages_per_chunk = 0, .summary = false});
  const Outcome got = run(whole.substr(0, 8) + mcap_record(0x7F, "new") + whole.substr(8));
  EXPECT_EQ(got.scans.size(), 2U);
  EXPECT_TRUE(got.errors.empty());
}

TEST(McapWriter, ScansComeBackAndAreWrittenAgainByteForByte) {
  const TemporaryFolder folder;
  std::vector<Scan> scans;
  for (int i = 0; i < 5; ++i) scans.push_back(some_scan(1000 + i, kBegin + i * 100'000'000LL));
  for (const Packing packing : {Packing::kNone, Packing::kLz4, Packing::kZstd}) {
    const McapWriterOptions options{.packing = packing, .chunk_bytes = 40'000};
    write_all(folder.path() / "a.mcap", scans, options);
    const std::string bytes = text_of(folder.path() / "a.mcap");
    const std::vector<Scan> back = read_all(bytes);
    ASSERT_EQ(back.size(), scans.size());
    for (std::size_t i = 0; i < scans.size(); ++i) {
      EXPECT_EQ(back[i].x, scans[i].x);
      EXPECT_EQ(back[i].ring_begin, scans[i].ring_begin);
      EXPECT_EQ(back[i].time_offset_ns, scans[i].time_offset_ns);
      EXPECT_EQ(back[i].stamp_ns, scans[i].stamp_ns);
    }
    write_all(folder.path() / "b.mcap", back, options);
    EXPECT_EQ(text_of(folder.path() / "b.mcap"), bytes);
  }
}

TEST(McapWriter, PosesAndMotionComeBackBitForBit) {
  const TemporaryFolder folder;
  std::vector<Scan> scans;
  for (int i = 0; i < 4; ++i) {
    scans.push_back(some_scan(1000, kBegin + i * 100'000'000LL));
    const Pose begin{from_yaw_pitch_roll(0.1 * i, 0.01, -0.02), {1.0 * i, 0.3, 0.1}};
    const Pose end{from_yaw_pitch_roll(0.1 * i + 0.05, 0.01, -0.02), {1.0 * i + 0.5, 0.3, 0.1}};
    scans.back().T_world_sensor = begin;
    scans.back().motion = Motion{begin, end, 999'000};  // to the last point, as a reader finds it
  }
  write_all(folder.path() / "a.mcap", scans);
  const std::string bytes = text_of(folder.path() / "a.mcap");
  const std::vector<Scan> back = read_all(bytes);
  ASSERT_EQ(back.size(), 4U);
  for (std::size_t i = 0; i < 4; ++i) {
    ASSERT_TRUE(back[i].motion && back[i].T_world_sensor);
    EXPECT_EQ(*back[i].T_world_sensor, *scans[i].T_world_sensor);
    EXPECT_EQ(back[i].motion->T_world_sensor_end, scans[i].motion->T_world_sensor_end);
  }
  write_all(folder.path() / "b.mcap", back);
  EXPECT_EQ(text_of(folder.path() / "b.mcap"), bytes);
}

TEST(McapWriter, ItsIndexesLeadToItsMessages) {
  const TemporaryFolder folder;
  write_all(folder.path() / "a.mcap", {some_scan(100, kBegin), some_scan(120, kBegin + 1)},
            {.packing = Packing::kNone, .chunk_bytes = 1});
  const std::string bytes = text_of(folder.path() / "a.mcap");
  const Bytes raw = bytes_of(bytes);
  const auto summary_start = load_le<std::uint64_t>(raw, bytes.size() - 8 - 20);
  std::size_t chunks = 0;
  for (std::size_t at = summary_start; bytes[at] != 0x02; at += 9 + load_le<std::uint64_t>(raw, at + 1)) {
    if (bytes[at] != 0x08) continue;
    ++chunks;
    const auto chunk = load_le<std::uint64_t>(raw, at + 9 + 16);
    EXPECT_EQ(bytes[chunk], 0x06);
    EXPECT_EQ(load_le<std::uint64_t>(raw, at + 9 + 24), 9 + load_le<std::uint64_t>(raw, chunk + 1));
    EXPECT_EQ(load_le<std::uint32_t>(raw, at + 9 + 32), 10U);  // one channel
    const auto index = load_le<std::uint64_t>(raw, at + 9 + 38);
    EXPECT_EQ(bytes[index], 0x07);
    const auto offset = load_le<std::uint64_t>(raw, index + 9 + 2 + 4 + 8);
    EXPECT_EQ(bytes[chunk + 9 + 40 + offset], 0x05);  // a message
  }
  EXPECT_EQ(chunks, 2U);
}

TEST(McapWriter, AFileOfNoScansIsAFile) {
  const TemporaryFolder folder;
  write_all(folder.path() / "a.mcap", {});
  const auto got = run(text_of(folder.path() / "a.mcap"));
  ASSERT_EQ(got.errors.size(), 1U);
  EXPECT_EQ(got.errors[0].what, "no topic has scans");
}

TEST(McapWriter, WhatRosCannotSayIsAnError) {
  const TemporaryFolder folder;
  auto writer = McapWriter::create(folder.path() / "a.mcap");
  ASSERT_TRUE(writer);
  const auto written = writer->add(some_scan(10, 2'147'483'648'000'000'000));
  ASSERT_FALSE(written);
  EXPECT_EQ(written.error().code, ErrorCode::kCannotWrite);
  EXPECT_FALSE(McapWriter::create(folder.path() / "missing" / "a.mcap"));
}

TEST(McapWriter, WithoutFinishThereIsNoFile) {
  const TemporaryFolder folder;
  {
    auto writer = McapWriter::create(folder.path() / "a.mcap");
    ASSERT_TRUE(writer && writer->add(some_scan(10, kBegin)));
  }
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

}  // namespace verge::io
