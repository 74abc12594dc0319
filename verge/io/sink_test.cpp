// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/io/sink.hpp"

#include <cmath>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "verge/io/formats.hpp"
#include "verge/io/test_files.hpp"
#include "verge/scan/organise.hpp"

namespace verge::io {
namespace {

namespace fs = std::filesystem;

constexpr std::int64_t kStamp = 1'700'000'000'123'456'789;

/// Three rings of 40 points, from the top, with every column that a scan can have.
Cloud full_cloud() {
  Cloud cloud;
  for (int ring = 2; ring >= 0; --ring) {
    for (int i = 0; i < 40; ++i) {
      const float angle = 0.15F * static_cast<float>(i) - 3.0F;
      cloud.x.push_back(10.0F * std::cos(angle));
      cloud.y.push_back(10.0F * std::sin(angle));
      cloud.z.push_back(0.3F * static_cast<float>(ring) - 1.0F);
      cloud.intensity.push_back(0.1F * static_cast<float>(i));
      cloud.ring.push_back(ring);
      cloud.time_s.push_back(1e-9 * (1'234'567 * i + ring));
      cloud.echo.push_back(static_cast<std::uint8_t>(i % 3));
      cloud.pulse_width.push_back(0.01F * static_cast<float>(i));
      cloud.flags.push_back(static_cast<std::uint32_t>(i * 7));
      cloud.label.push_back(static_cast<std::uint32_t>(40 + ring));
    }
  }
  return cloud;
}

Scan full_scan() {
  Scan scan = organise(full_cloud()).scan;
  scan.frame = "000000";
  scan.stamp_ns = kStamp;
  return scan;
}

std::string bytes_in(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::ostringstream bytes;
  bytes << in.rdbuf();
  return bytes.str();
}

void write_all(const fs::path& path, const std::vector<Scan>& scans, SinkOptions options = {}) {
  auto sink = create(path, options);
  ASSERT_TRUE(sink) << to_string(sink.error());
  for (const Scan& scan : scans) ASSERT_TRUE((*sink)->write(scan));
  ASSERT_TRUE((*sink)->finish());
}

std::vector<Scan> read_all(const fs::path& path) {
  std::vector<Scan> scans;
  auto source = open(path);
  EXPECT_TRUE(source) << to_string(source.error());
  while (source) {
    auto scan = (*source)->next();
    EXPECT_TRUE(scan) << to_string(scan.error());
    if (!scan || !*scan) break;
    scans.push_back(*std::move(*scan));
  }
  return scans;
}

/// What every format holds comes back bit for bit and in the input's order.
void expect_same_places(const Scan& a, const Scan& b) {
  const Cloud p = flatten(a);
  const Cloud q = flatten(b);
  EXPECT_EQ(p.x, q.x);
  EXPECT_EQ(p.y, q.y);
  EXPECT_EQ(p.z, q.z);
  EXPECT_EQ(p.ring, q.ring);
  EXPECT_EQ(p.intensity, q.intensity);
}

class EveryColumn : public ::testing::TestWithParam<const char*> {};

TEST_P(EveryColumn, ComesBackBitForBit) {
  const testing::TemporaryFolder folder;
  const fs::path file = folder.path() / GetParam();
  const Scan scan = full_scan();
  write_all(file, {scan});
  const auto back = read_all(file);
  ASSERT_EQ(back.size(), 1U);
  expect_same_places(back[0], scan);
  EXPECT_EQ(back[0].stamp_ns, scan.stamp_ns);
  EXPECT_EQ(back[0].time_offset_ns, scan.time_offset_ns);
  EXPECT_EQ(back[0].echo, scan.echo);
  EXPECT_EQ(back[0].pulse_width, scan.pulse_width);
  EXPECT_EQ(back[0].flags, scan.flags);
  EXPECT_EQ(back[0].label, scan.label);
}

TEST_P(EveryColumn, WritingWhatWasReadGivesTheSameBytes) {
  const testing::TemporaryFolder folder;
  const fs::path first = folder.path() / (std::string("1") + GetParam());
  const fs::path second = folder.path() / (std::string("2") + GetParam());
  write_all(first, {full_scan()});
  write_all(second, read_all(first));
  EXPECT_GT(bytes_in(first).size(), 1000U);
  EXPECT_TRUE(bytes_in(first) == bytes_in(second));
}

INSTANTIATE_TEST_SUITE_P(Formats, EveryColumn,
                         ::testing::Values("scan.pcd", "scan.ply", "scan.csv", "scan.mcap"),
                         [](const auto& instance) { return std::string(instance.param).substr(5); });

TEST(Sink, NuscenesKeepsPlacesRingsAndIntensities) {
  const testing::TemporaryFolder folder;
  write_all(folder.path() / "scan.pcd.bin", {full_scan()});
  expect_same_places(read_all(folder.path() / "scan.pcd.bin").at(0), full_scan());
}

TEST(Sink, AKittiFolderKeepsTheTimesAndPosesOfItsScans) {
  const testing::TemporaryFolder folder;
  std::vector<Scan> scans{full_scan(), full_scan(), full_scan()};
  for (std::size_t i = 0; i < scans.size(); ++i) {
    scans[i].stamp_ns = kStamp + 100'000'007 * static_cast<int>(i);
    scans[i].T_world_sensor = Pose{from_yaw_pitch_roll(0.3 * static_cast<double>(i), 0.02, -0.01),
                                   {1.5 * static_cast<double>(i), 2.0, 0.1}};
  }
  write_all(folder.path() / "drive", scans, {.format = Format::kKitti});
  const auto back = read_all(folder.path() / "drive");
  ASSERT_EQ(back.size(), 3U);
  for (std::size_t i = 0; i < scans.size(); ++i) {
    EXPECT_EQ(back[i].stamp_ns, scans[i].stamp_ns);
    ASSERT_TRUE(back[i].T_world_sensor);
    const Pose apart = inverse(*scans[i].T_world_sensor) * *back[i].T_world_sensor;
    EXPECT_LT(norm(apart.translation) + std::fabs(yaw_of(apart.rotation)), 1e-9);
    expect_same_places(back[i], scans[i]);
  }
}

/// The same points, the last first.
Scan reversed_scan() {
  Cloud cloud = full_cloud();
  std::reverse(cloud.x.begin(), cloud.x.end());
  std::reverse(cloud.y.begin(), cloud.y.end());
  std::reverse(cloud.z.begin(), cloud.z.end());
  std::reverse(cloud.ring.begin(), cloud.ring.end());
  Scan scan = organise(cloud).scan;
  scan.frame = "a";
  return scan;
}

TEST(Sink, KittiPutsRingsInOrderWhereTheyAreNot) {
  const Scan scan = reversed_scan();
  const testing::TemporaryFolder folder;
  write_all(folder.path() / "velodyne" / "..", {scan}, {.format = Format::kKitti});
  const auto back = read_all(folder.path());
  ASSERT_EQ(back.size(), 1U);
  EXPECT_EQ(back[0].x, scan.x);
  EXPECT_EQ(back[0].ring_begin, scan.ring_begin);
}

TEST(Sink, TheOrderOfAFilesPointsIsTold) {
  const Scan scan = reversed_scan();
  for (const Format format : {Format::kKitti, Format::kNuscenes, Format::kPcd, Format::kLas}) {
    const testing::TemporaryFolder folder;
    write_all(folder.path() / "drive", {scan}, {.format = format});
    const Cloud back = flatten(read_all(folder.path() / "drive").at(0));
    const std::vector<std::uint32_t> order = written_order(format, scan);
    ASSERT_EQ(back.x.size(), order.size());
    for (std::size_t i = 0; i < order.size(); ++i) {
      EXPECT_NEAR(double{back.x[i]}, double{scan.x[order[i]]}, 1e-4) << name_of(format);
      EXPECT_NEAR(double{back.z[i]}, double{scan.z[order[i]]}, 1e-4) << name_of(format);
    }
  }
}

TEST(Sink, AFolderHoldsManyScansByTheirNames) {
  const testing::TemporaryFolder folder;
  std::vector<Scan> scans{full_scan(), full_scan()};
  scans[1].frame = "000007";
  write_all(folder.path() / "out", scans, {.format = Format::kPcd});
  const auto back = read_all(folder.path() / "out");
  ASSERT_EQ(back.size(), 2U);
  EXPECT_EQ(back[1].frame, "000007");
}

TEST(Sink, ARecordingHoldsManyScansAndTheirTimes) {
  const testing::TemporaryFolder folder;
  std::vector<Scan> scans{full_scan(), full_scan(), full_scan()};
  for (std::size_t i = 0; i < scans.size(); ++i)
    scans[i].stamp_ns = kStamp + 100'000'007 * static_cast<int>(i);
  write_all(folder.path() / "drive.mcap", scans);
  const auto back = read_all(folder.path() / "drive.mcap");
  ASSERT_EQ(back.size(), 3U);
  for (std::size_t i = 0; i < scans.size(); ++i) {
    EXPECT_EQ(back[i].stamp_ns, scans[i].stamp_ns);
    EXPECT_EQ(back[i].time_offset_ns, scans[i].time_offset_ns);
    EXPECT_EQ(back[i].x, scans[i].x);
    EXPECT_EQ(back[i].y, scans[i].y);
    EXPECT_EQ(back[i].z, scans[i].z);
    EXPECT_EQ(back[i].intensity, scans[i].intensity);
    EXPECT_EQ(back[i].ring_begin, scans[i].ring_begin);
  }
}

TEST(Sink, AFileOfOneScanRefusesASecondAndDoesNotAppear) {
  const testing::TemporaryFolder folder;
  const fs::path file = folder.write("scan.pcd", "old");
  {
    auto sink = create(file);
    ASSERT_TRUE(sink);
    ASSERT_TRUE((*sink)->write(full_scan()));
    const auto second = (*sink)->write(full_scan());
    ASSERT_FALSE(second);
    EXPECT_EQ(second.error().code, ErrorCode::kUsage);
  }
  EXPECT_EQ(bytes_in(file), "old");
}

TEST(Sink, ANameThatSaysNoFormatIsAUsageError) {
  const testing::TemporaryFolder folder;
  const auto sink = create(folder.path() / "out");
  ASSERT_FALSE(sink);
  EXPECT_EQ(sink.error().code, ErrorCode::kUsage);
  EXPECT_NE(sink.error().need.find("kitti, nuscenes, pcd, ply, csv, las, ibeo, alasca, pcap, mcap"),
            std::string::npos)
      << sink.error().need;
}

TEST(Sink, AFolderWithOtherFilesIsRefusedAndStays) {
  const testing::TemporaryFolder folder;
  const fs::path other = folder.write("out/notes.txt", "mine");
  const auto sink = create(folder.path() / "out", {.format = Format::kPcd});
  ASSERT_FALSE(sink);
  EXPECT_EQ(sink.error().code, ErrorCode::kCannotWrite);
  EXPECT_EQ(bytes_in(other), "mine");
}

TEST(Sink, AFolderThatCannotBeMadeIsSaid) {
  const testing::TemporaryFolder folder;
  const fs::path file = folder.write("blocked", "");
  const auto sink = create(file / "out", {.format = Format::kPcd});
  ASSERT_FALSE(sink);
  EXPECT_EQ(sink.error().code, ErrorCode::kCannotWrite);
}

}  // namespace
}  // namespace verge::io
