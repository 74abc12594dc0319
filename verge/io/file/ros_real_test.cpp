// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0

// Real recordings of ROS 2, read from beginning to end. Skipped where VERGE_DATA is not set.
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "verge/io/file/pcd.hpp"
#include "verge/io/file/rosbag2.hpp"
#include "verge/io/file/test_bags.hpp"
#include "verge/io/test_files.hpp"

namespace verge::io {
namespace {

using testing::data_folder;
using testing::Outcome;
using testing::read_through;

struct RealBag {
  std::string folder;
  std::uint64_t messages;
  std::uint64_t packets;
  std::size_t most_rings;
  std::string frame;
};

class RealBags : public ::testing::TestWithParam<RealBag> {};

INSTANTIATE_TEST_SUITE_P(Velodyne, RealBags,
                         ::testing::Values(RealBag{"vlp16/1673400471837873222", 4, 603, 16, "velodyne"},
                                           RealBag{"vlp32/1713492677464078412", 5, 379, 32,
                                                   "velodyne_front"}));

TEST_P(RealBags, FolderAndFileGiveTheirRevolutions) {
  if (!data_folder()) GTEST_SKIP() << "VERGE_DATA is not set: no real scans";
  const RealBag& bag = GetParam();
  const auto folder = *data_folder() / "velodyne-packets" / bag.folder;
  const Outcome by_folder = read_through(open_rosbag2_folder(folder, {}, {}));
  ASSERT_TRUE(by_folder.errors.empty()) << to_string(by_folder.errors.front());
  EXPECT_EQ(by_folder.counters.at("messages received"), bag.messages);
  EXPECT_EQ(by_folder.counters.at("packets received"), bag.packets);
  EXPECT_EQ(by_folder.counters.at("packets used"), bag.packets);
  // A message is about a revolution; the recording may begin and end amid one.
  EXPECT_GE(by_folder.scans.size(), bag.messages - 1);
  EXPECT_LE(by_folder.scans.size(), bag.messages + 1);
  for (const Decoded& scan : by_folder.scans) {
    EXPECT_EQ(scan.frame_id, bag.frame);
    ASSERT_TRUE(scan.stamp_ns);
    for (const std::int64_t ring : scan.cloud.ring) {
      ASSERT_GE(ring, 0);
      ASSERT_LT(ring, static_cast<std::int64_t>(bag.most_rings));
    }
  }
  auto files = find_rosbag2_files(folder);
  ASSERT_EQ(files.size(), 1U);
  auto input = Input::open(files.front(), {});
  ASSERT_TRUE(input);
  const Outcome by_file = read_through(open_db3(*std::move(input), {}));
  ASSERT_EQ(by_file.scans.size(), by_folder.scans.size());
  for (std::size_t i = 0; i < by_file.scans.size(); ++i)
    EXPECT_EQ(by_file.scans[i].cloud.x, by_folder.scans[i].cloud.x);
}

// The driver's reference clouds of one message or revolution of these bags. Their points stand in the order
// of firing, as ours do over all scans.

struct Shots {
  std::vector<double> range_m, elevation_rad, azimuth_deg;  // clockwise from ahead, 0..360
  void add(const Cloud& cloud) {
    for (std::size_t i = 0; i < cloud.x.size(); ++i) {
      const double x = cloud.x[i];
      const double y = cloud.y[i];
      const double z = cloud.z[i];
      const double azimuth = std::atan2(-y, x) * 180.0 / std::numbers::pi;
      range_m.push_back(std::sqrt(x * x + y * y + z * z));
      elevation_rad.push_back(std::asin(z / range_m.back()));
      azimuth_deg.push_back(azimuth < 0.0 ? azimuth + 360.0 : azimuth);
    }
  }
};

Shots ours(const std::string& folder) {
  Shots shots;
  const auto scans =
      read_through(open_rosbag2_folder(*data_folder() / "velodyne-packets" / folder, {}, {})).scans;
  for (const Decoded& scan : scans) shots.add(scan.cloud);
  return shots;
}

Shots reference(const std::string& file) {
  Shots shots;
  auto input = Input::open(*data_folder() / "velodyne-packets" / file, {});
  if (auto decoded = read_pcd(*input)) shots.add(decoded->cloud);
  return shots;
}

/// The points [begin, end) of the reference are ours from `at` on: ranges to 2 mm, elevations to 0.01
/// degrees, azimuths to `azimuth_deg`.
void expect_same(const Shots& theirs, std::size_t begin, std::size_t end, const Shots& own, std::size_t at,
                 double azimuth_deg) {
  ASSERT_LE(at + end - begin, own.range_m.size());
  ASSERT_LE(end, theirs.range_m.size());
  for (std::size_t i = begin; i < end; ++i, ++at) {
    ASSERT_NEAR(theirs.range_m[i], own.range_m[at], 0.002) << i;
    ASSERT_NEAR(theirs.elevation_rad[i], own.elevation_rad[at], 0.01 * std::numbers::pi / 180.0) << i;
    ASSERT_NEAR(std::remainder(theirs.azimuth_deg[i] - own.azimuth_deg[at], 360.0), 0.0, azimuth_deg) << i;
  }
}

TEST(RealReference, OfTheVlp16IsATurnFromZeroWithoutItsThreePairsOfBlocksBehind359Degrees) {
  if (!data_folder()) GTEST_SKIP() << "VERGE_DATA is not set: no real scans";
  const Shots own = ours("vlp16/1673400471837873222");
  const Shots theirs = reference("vlp16/1673400472138016708.pcd");
  constexpr std::size_t kBegin = 44'503;
  constexpr std::size_t kPoints = 14'831;
  constexpr std::size_t kBehind = 48;
  ASSERT_EQ(theirs.range_m.size(), kPoints);
  expect_same(theirs, 0, kPoints, own, kBegin, 0.41);
  // The head turns by 0.4 degrees in a block: the one before ends behind 0, the first begins at 0.30.
  EXPECT_NEAR(own.azimuth_deg[kBegin - 1], 359.90 + 0.32 - 360.0, 0.01);
  EXPECT_NEAR(own.azimuth_deg[kBegin], 0.30, 0.01);
  EXPECT_LT(own.azimuth_deg[kBegin + kPoints - 1], 359.0);
  for (std::size_t i = kBegin + kPoints; i < kBegin + kPoints + kBehind; ++i) {
    EXPECT_GE(own.azimuth_deg[i] < 1.0 ? own.azimuth_deg[i] + 360.0 : own.azimuth_deg[i], 359.05) << i;
  }
  EXPECT_NEAR(own.azimuth_deg[kBegin + kPoints + kBehind], 0.23, 0.02);
}

TEST(RealReference, OfTheVlp32cIsTheFirstMessageWithoutItsFiveBlocksBehindNinetyDegrees) {
  if (!data_folder()) GTEST_SKIP() << "VERGE_DATA is not set: no real scans";
  const Shots own = ours("vlp32/1713492677464078412");
  const Shots theirs = reference("vlp32/1713492677464078412.pcd");
  // Of the message's last packet: 3 blocks before 90 degrees, 5 behind it, and 4 of the next sweep.
  constexpr std::size_t kSweep = 26'089;
  constexpr std::size_t kBehind = 114;
  constexpr std::size_t kNext = 127;
  ASSERT_EQ(theirs.range_m.size(), kSweep + kNext);
  expect_same(theirs, 0, kSweep, own, 0, 0.16);
  expect_same(theirs, kSweep, kSweep + kNext, own, kSweep + kBehind, 0.16);
  for (std::size_t i = kSweep; i < kSweep + kBehind; ++i) {
    // Lasers point up to 4.2 degrees off the head's azimuth, which goes from 90.14 to 90.95 degrees and on.
    ASSERT_GE(own.azimuth_deg[i], 90.14 - 4.21) << i;
    ASSERT_LE(own.azimuth_deg[i], 90.95 + 0.21 + 4.21) << i;
  }
}

}  // namespace
}  // namespace verge::io
