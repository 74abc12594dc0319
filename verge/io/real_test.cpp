// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0

// Real recordings, read from beginning to end. Skipped where VERGE_DATA is not set.
#include <algorithm>
#include <map>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "verge/io/source.hpp"
#include "verge/io/test_files.hpp"

namespace verge::io {
namespace {

using testing::data_folder;

#define VERGE_NEEDS_DATA() \
  if (!data_folder()) GTEST_SKIP() << "VERGE_DATA is not set: no real scans"

/// All scans of a path below VERGE_DATA; every one has to be readable.
std::vector<Scan> read_all(const std::string& path) {
  const auto source = open(*data_folder() / path);
  if (!source) {
    ADD_FAILURE() << to_string(source.error());
    return {};
  }
  std::vector<Scan> scans;
  while (true) {
    auto scan = (*source)->next();
    if (!scan) {
      ADD_FAILURE() << to_string(scan.error());
      continue;
    }
    if (!*scan) return scans;
    scans.push_back(std::move(**scan));
  }
}

}  // namespace

TEST(Real, SemanticKittiHas16ScansOf64RingsWithPosesAndMotion) {
  VERGE_NEEDS_DATA();
  const std::vector<Scan> scans = read_all("semantickitti/sequences/00/velodyne");
  ASSERT_EQ(scans.size(), 16U);
  for (const Scan& scan : scans) {
    EXPECT_EQ(scan.ring_count(), 64U) << scan.frame;
    EXPECT_EQ(scan.dropped, 0U);
    ASSERT_TRUE(scan.T_world_sensor && scan.motion);
    // A car in a town: 0.85 m in 0.1 s, ahead, which is x.
    const Vec3 step =
        (inverse(scan.motion->T_world_sensor_begin) * scan.motion->T_world_sensor_end).translation;
    EXPECT_NEAR(step.x, 0.85, 0.2) << scan.frame;
    EXPECT_NEAR(step.y, 0.0, 0.1);
    EXPECT_NEAR(step.z, 0.0, 0.1);
    EXPECT_EQ(scan.motion->duration_ns, 100'000'000);
  }
  EXPECT_EQ(scans.front().size(), 124668U);
  EXPECT_EQ(scans.front().frame, "000000");
  EXPECT_EQ(scans.back().frame, "000015");
}

TEST(Real, TheSequenceFolderFindsItsScans) {
  VERGE_NEEDS_DATA();
  const auto source = open(*data_folder() / "semantickitti/sequences/00");
  ASSERT_TRUE(source) << to_string(source.error());
  EXPECT_EQ((*source)->info().files.size(), 16U);
}

TEST(Real, NuscenesHas14ScansOf32Rings) {
  VERGE_NEEDS_DATA();
  const std::vector<Scan> scans = read_all("nuscenes-hdl32/labelled/LIDAR_TOP");
  ASSERT_EQ(scans.size(), 14U);
  for (const Scan& scan : scans) EXPECT_EQ(scan.ring_count(), 32U) << scan.frame;
  EXPECT_EQ(scans.front().size(), 503440U / 20U);
  EXPECT_EQ(scans.front().frame, "000000");
}

TEST(Real, TheFullNuscenesSweepHas34688PointsAndLooksDownInRing0) {
  VERGE_NEEDS_DATA();
  const std::vector<Scan> scans = read_all("nuscenes-hdl32/raw/n015.pcd.bin");
  ASSERT_EQ(scans.size(), 1U);
  EXPECT_EQ(scans[0].size(), 34688U);
  EXPECT_EQ(scans[0].ring_count(), 32U);
  const auto [begin, end] = scans[0].ring(0);
  std::vector<float> sines;
  for (std::size_t i = begin; i < end; ++i) sines.push_back(scans[0].z[i] / scans[0].range[i]);
  std::nth_element(sines.begin(), sines.begin() + 500, sines.end());
  EXPECT_NEAR(sines[500], -0.51, 0.01);  // the HDL-32E's lowest laser looks 30.67 degrees down
}

TEST(Real, Vlp16Has21ScansOf16Rings) {
  VERGE_NEEDS_DATA();
  const std::vector<Scan> scans = read_all("vlp16-kerb-labels");
  ASSERT_EQ(scans.size(), 21U);
  for (const Scan& scan : scans) EXPECT_EQ(scan.ring_count(), 16U) << scan.frame;
  EXPECT_EQ(scans.front().size() + scans.front().dropped, 27723U);
}

TEST(Real, EveryPcdOfTheVarietyIsRead) {
  VERGE_NEEDS_DATA();
  struct Expectation {
    std::size_t points;
    std::size_t rings;  // 0: the file does not say
    bool times;
  };
  const std::map<std::string, Expectation> expected{{"hdl32e_koide_indoor_251370668", {69088, 0, false}},
                                                    {"l2c_ours_1_calib", {101340, 64, true}},
                                                    {"l2l_0001_top", {92677, 64, true}},
                                                    {"l2l_manual_p64", {77547, 64, true}},
                                                    {"os128_patchwork_000000", {240000, 128, true}},
                                                    {"velodyne_vlp_16", {26926, 16, false}}};
  const std::vector<Scan> scans = read_all("pcd-variety");
  ASSERT_EQ(scans.size(), expected.size());
  for (const Scan& scan : scans) {
    const Expectation& want = expected.at(scan.frame);
    EXPECT_EQ(scan.size() + scan.dropped, want.points) << scan.frame;
    EXPECT_TRUE(want.rings == 0 || scan.ring_count() == want.rings)
        << scan.frame << ": " << scan.ring_count();
    EXPECT_EQ(scan.stamp_ns.has_value(), want.times) << scan.frame;
    if (!want.times) continue;
    // One revolution, which took 0.1 s.
    const auto last = *std::max_element(scan.time_offset_ns.begin(), scan.time_offset_ns.end());
    EXPECT_NEAR(last, 100e6, 15e6) << scan.frame;
  }
}

TEST(Real, Returns0OfAnOrganisedCloudStayAndCountAsNoReturn) {
  VERGE_NEEDS_DATA();
  const std::vector<Scan> scans = read_all("pcd-variety/os128_patchwork_000000.pcd");
  ASSERT_EQ(scans.size(), 1U);
  EXPECT_EQ(std::count(scans[0].range.begin(), scans[0].range.end(), 0.0F), 34102);
}

TEST(Real, DriversReferenceCloudsAreRead) {
  VERGE_NEEDS_DATA();
  const std::vector<Scan> vlp16 = read_all("velodyne-packets/vlp16/1673400472138016708.pcd");
  ASSERT_EQ(vlp16.size(), 1U);
  EXPECT_EQ(vlp16[0].size(), 14831U);
  EXPECT_EQ(vlp16[0].ring_count(), 15U);  // its field is named channel; nothing came back in one of 16
  EXPECT_FALSE(vlp16[0].time_offset_ns.empty());
  const std::vector<Scan> vlp32 = read_all("velodyne-packets/vlp32/1713492677464078412.pcd");
  ASSERT_EQ(vlp32.size(), 1U);
  EXPECT_EQ(vlp32[0].size(), 26216U);
}

}  // namespace verge::io
