// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/io/kitti_oxts.hpp"

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "verge/io/kitti_sequence.hpp"
#include "verge/io/source.hpp"
#include "verge/io/test_files.hpp"

namespace verge::io {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;
using testing::TemporaryFolder;

constexpr double kMetresPerDegree = 6378137.0 * std::numbers::pi / 180.0;
// The unit stands 0.8 m behind and 0.3 m right of the lidar, 0.5 m lower.
constexpr const char* kCalib = "calib_time: 25-May-2012\nR: 1 0 0 0 1 0 0 0 1\nT: -0.8 -0.3 -0.5\n";

/// A row of oxts/data `north_m` north of the equator's origin, heading north.
std::string fix_row(double north_m) {
  return std::to_string(north_m / kMetresPerDegree) + " 8.0 100.0 0 0 1.5707963267948966 0 0 0 0 0 0\n";
}

/// A raw drive of three scans, at 0.0, 0.1 and 0.2 s, and three fixes at 0.0, 0.2 and 0.4 s, 10 m apart.
std::filesystem::path raw_drive(const TemporaryFolder& folder) {
  const std::filesystem::path drive = "2011_09_26/2011_09_26_drive_0001_sync";
  for (int i = 0; i < 3; ++i) {
    const std::string name = "000000000" + std::to_string(i);
    folder.write(drive / "velodyne_points/data" / (name + ".bin"), testing::kitti_rings(3, 30));
    folder.write(drive / "oxts/data" / (name + ".txt"), fix_row(10.0 * i));
  }
  folder.write(
      drive / "velodyne_points/timestamps.txt",
      "2011-09-26 13:02:25.000000000\n2011-09-26 13:02:25.100000000\n2011-09-26 13:02:25.200000000\n");
  folder.write(
      drive / "oxts/timestamps.txt",
      "2011-09-26 13:02:25.000000000\n2011-09-26 13:02:25.200000000\n2011-09-26 13:02:25.400000000\n");
  folder.write("2011_09_26/calib_imu_to_velo.txt", kCalib);
  return folder.path() / drive;
}

}  // namespace

TEST(Oxts, ProjectsAsMetresEastAndNorth) {
  // At 49 degrees north a degree of longitude is cos(49 deg) as long as at the equator.
  const OxtsFix fix{49.0, 8.001, 110.0, 0.01, 0.02, 0.5};
  const Pose a = pose_of(fix, 49.0);
  const Pose b = pose_of({49.001, 8.0, 110.0, 0.0, 0.0, 0.0}, 49.0);
  EXPECT_NEAR(a.translation.x - b.translation.x,
              0.001 * kMetresPerDegree * std::cos(49.0 * std::numbers::pi / 180.0), 1e-6);
  EXPECT_NEAR(b.translation.y - a.translation.y, 0.001 * kMetresPerDegree, 0.002);
  EXPECT_DOUBLE_EQ(a.translation.z, 110.0);
  EXPECT_NEAR(yaw_of(a.rotation), 0.5, 1e-12);
}

TEST(Oxts, ARowNeedsSixNumbersOnEarth) {
  EXPECT_TRUE(parse_oxts("49.01 8.42 112.8 0.03 0.02 -0.4 1 2 3"));
  for (const char* row : {"", "1 2 3 4 5", "49 8 112 nan 0 0", "91 8 112 0 0 0", "49 x 112 0 0 0"}) {
    EXPECT_FALSE(parse_oxts(row)) << row;
  }
}

TEST(Oxts, ScansOfARawDriveHaveThePosesBetweenTheFixes) {
  const TemporaryFolder folder;
  const auto source = open(raw_drive(folder));
  ASSERT_TRUE(source);
  // The lidar's x axis points where the vehicle drives: north.
  for (const double ahead : {0.0, 5.0, 10.0}) {
    const auto scan = (*source)->next();
    ASSERT_TRUE(scan && *scan);
    ASSERT_TRUE((*scan)->T_world_sensor);
    EXPECT_NEAR((*scan)->T_world_sensor->translation.x, ahead, 0.06);  // six decimals of a degree
    EXPECT_NEAR((*scan)->T_world_sensor->translation.y, 0.0, 1e-6);
    EXPECT_TRUE((*scan)->motion);
  }
}

TEST(Oxts, WhatIsMissingIsSaid) {
  const TemporaryFolder folder;
  const auto drive = raw_drive(folder);
  const std::vector<std::int64_t> stamps{0};
  std::vector<std::string> warnings;
  const Log log = [&](LogLevel level, std::string_view text) {
    if (level == LogLevel::kWarning) warnings.emplace_back(text);
  };
  folder.write("2011_09_26/2011_09_26_drive_0001_sync/oxts/timestamps.txt", "2011-09-26 13:02:25.0\n");
  EXPECT_THAT(find_oxts_poses(drive / "velodyne_points/data", stamps, {}, log), IsEmpty());
  folder.write("2011_09_26/calib_imu_to_velo.txt", "R: 1 0 0\n");
  EXPECT_THAT(find_oxts_poses(drive / "velodyne_points/data", stamps, {}, log), IsEmpty());
  ASSERT_EQ(warnings.size(), 2U);
  EXPECT_THAT(warnings[0], HasSubstr("1 times, 3 fixes"));
  EXPECT_THAT(warnings[1], HasSubstr("calib_imu_to_velo.txt"));
  EXPECT_THAT(find_oxts_poses(folder.path(), stamps, {}, log), IsEmpty());
}

}  // namespace verge::io
