// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0

// Real recordings of ROS 2, read from beginning to end. Skipped where VERGE_DATA is not set.
#include <cmath>
#include <string>

#include <gtest/gtest.h>

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

}  // namespace
}  // namespace verge::io
