// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0

// What organise() makes of real scans. Skipped where VERGE_DATA is not set.
#include <algorithm>
#include <map>
#include <utility>

#include <gtest/gtest.h>

#include "verge/scan/organise.hpp"
#include "verge/scan/test_clouds.hpp"

namespace verge {
namespace {

using testing::data_folder;
using testing::files_in;

#define VERGE_NEEDS_DATA() \
  if (!data_folder()) GTEST_SKIP() << "VERGE_DATA is not set: no real scans"

// Share of the points that lie in the ring where most of the points of their true ring lie, when the ring
// field is hidden.
double share_in_their_ring(Cloud cloud, std::string& note) {
  const std::vector<std::int64_t> truth = std::exchange(cloud.ring, {});
  const Organised organised = organise(std::move(cloud));
  note = organised.note;
  EXPECT_EQ(organised.source, RingSource::kElevation);
  std::map<std::int64_t, std::map<std::size_t, std::size_t>> count;
  for (std::size_t r = 0; r < organised.scan.ring_count(); ++r) {
    const auto [begin, end] = organised.scan.ring(r);
    for (std::size_t i = begin; i < end; ++i) ++count[truth[organised.scan.input_index[i]]][r];
  }
  std::size_t agree = 0;
  std::map<std::size_t, std::size_t> taken;  // a ring may be the home of one true ring only
  for (const auto& [ring, found] : count) {
    const auto best = std::max_element(found.begin(), found.end(),
                                       [](const auto& a, const auto& b) { return a.second < b.second; });
    taken[best->first] = std::max(taken[best->first], best->second);
  }
  for (const auto& [ring, points] : taken) agree += points;
  return static_cast<double>(agree) / static_cast<double>(truth.size());
}

}  // namespace

TEST(OrganiseReal, Hdl64FilesHave64RingsInOrder) {
  VERGE_NEEDS_DATA();
  const auto files = files_in(*data_folder() / "semantickitti/sequences/00/velodyne", ".bin");
  ASSERT_FALSE(files.empty());
  for (const auto& file : files) {
    const Organised organised = organise(testing::read_kitti(file));
    EXPECT_EQ(organised.source, RingSource::kKittiOrder) << file << ": " << organised.note;
    EXPECT_EQ(organised.scan.ring_count(), 64U) << file << ": " << organised.note;
  }
}

TEST(OrganiseReal, Vlp16RingsComeBackFromElevation) {
  VERGE_NEEDS_DATA();
  const auto files = files_in(*data_folder() / "vlp16-kerb-labels", ".pcd");
  ASSERT_FALSE(files.empty());
  for (const auto& file : files) {
    std::string note;
    EXPECT_GT(share_in_their_ring(testing::read_pcd(file, 18, 16), note), 0.99) << file << ": " << note;
  }
}

TEST(OrganiseReal, Hdl32RingsComeBackFromElevation) {
  VERGE_NEEDS_DATA();
  const auto file = *data_folder() / "pcd-variety/hdl32e_koide_indoor_251370668.pcd";
  const Cloud cloud = testing::read_pcd(file, 16, std::nullopt);
  ASSERT_GT(cloud.x.size(), 60000U);
  const Organised organised = organise(cloud);
  EXPECT_EQ(organised.source, RingSource::kElevation);
  EXPECT_EQ(organised.scan.ring_count(), 32U) << organised.note;
}

TEST(OrganiseReal, FlatteningGivesRealScansBackBitForBit) {
  VERGE_NEEDS_DATA();
  const Cloud hdl64 = testing::read_kitti(*data_folder() / "semantickitti/sequences/00/velodyne/000000.bin");
  const Cloud hdl32 = testing::read_nuscenes(*data_folder() / "nuscenes-hdl32/raw/n015.pcd.bin");
  for (const Cloud& cloud : {hdl64, hdl32}) {
    ASSERT_GT(cloud.x.size(), 30000U);
    const Cloud back = flatten(organise(cloud).scan);
    EXPECT_TRUE(back.x == cloud.x && back.y == cloud.y && back.z == cloud.z);
    EXPECT_TRUE(back.intensity == cloud.intensity);
  }
}

TEST(OrganiseReal, ShufflingChangesNothingWhereRingsAreKnown) {
  VERGE_NEEDS_DATA();
  const Cloud cloud = testing::read_nuscenes(*data_folder() / "nuscenes-hdl32/raw/n015.pcd.bin");
  ASSERT_GT(cloud.x.size(), 30000U);
  const Scan a = organise(cloud).scan;
  const Scan b = organise(testing::shuffled(cloud, 11)).scan;
  EXPECT_EQ(a.ring_begin, b.ring_begin);
  EXPECT_TRUE(a.x == b.x && a.y == b.y && a.z == b.z && a.azimuth == b.azimuth && a.range == b.range);
  EXPECT_TRUE(a.intensity == b.intensity);
}

TEST(OrganiseReal, ShuffledHdl64IsNotTakenForRingByRing) {
  VERGE_NEEDS_DATA();
  const Cloud cloud = testing::read_kitti(*data_folder() / "semantickitti/sequences/00/velodyne/000000.bin");
  ASSERT_GT(cloud.x.size(), 100000U);
  EXPECT_EQ(organise(testing::shuffled(cloud, 3)).source, RingSource::kElevation);
}

}  // namespace verge
