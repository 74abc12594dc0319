// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/io/kitti_sequence.hpp"

#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "verge/io/test_files.hpp"

namespace verge::io {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using testing::TemporaryFolder;

// A camera that looks ahead (its z), right of it is x, down is y; 0.3 m ahead of and 0.1 m below the lidar.
constexpr const char* kCalib =
    "P0: 7e+02 0 6e+02 0 0 7e+02 1e+02 0 0 0 1 0\n"
    "Tr: 0 -1 0 0  0 0 -1 -0.1  1 0 0 -0.3\n";
// The camera drives 2 m ahead, then 1 m ahead while it turns left by 90 degrees (about its -y).
constexpr const char* kPoses =
    "1 0 0 0 0 1 0 0 0 0 1 0\n"
    "1 0 0 0 0 1 0 0 0 0 1 2\n"
    "0 0 -1 0 0 1 0 0 1 0 0 3\n";

struct Heard {
  std::vector<std::string> notes;
  std::vector<std::string> warnings;
  [[nodiscard]] Log log() {
    return [this](LogLevel level, std::string_view text) {
      (level == LogLevel::kNote ? notes : warnings).emplace_back(text);
    };
  }
};

void expect_near(Vec3 a, Vec3 b) {
  EXPECT_NEAR(a.x, b.x, 1e-12);
  EXPECT_NEAR(a.y, b.y, 1e-12);
  EXPECT_NEAR(a.z, b.z, 1e-12);
}

}  // namespace

TEST(KittiSequence, PosesOfTheCameraBecomePosesOfTheLidar) {
  const TemporaryFolder folder;
  folder.write("poses.txt", kPoses);
  folder.write("calib.txt", kCalib);
  Heard heard;
  const auto scans = folder.path() / "velodyne";
  const ScanTrack sequence = find_kitti_sequence(scans, {}, heard.log());
  EXPECT_THAT(heard.warnings, IsEmpty());
  ASSERT_EQ(sequence.T_world_sensor.size(), 3U);
  expect_near(sequence.T_world_sensor[0].translation, {0, 0, 0});
  expect_near(sequence.T_world_sensor[1].translation, {2, 0, 0});
  // The camera is 0.3 m ahead of the lidar. It stands at 3 + 0.3 and looks left (+y): the lidar is behind it.
  expect_near(sequence.T_world_sensor[2].translation, {3.3, -0.3, 0});
  EXPECT_NEAR(yaw_of(sequence.T_world_sensor[2].rotation), 1.5707963267948966, 1e-12);
}

TEST(KittiSequence, MotionLeadsToTheNextPoseAndOnFromTheLast) {
  const TemporaryFolder folder;
  folder.write("poses.txt", kPoses);
  folder.write("calib.txt", kCalib);
  folder.write("times.txt", "0.000000e+00\n1.036224e-01\n2.1e-01\n");
  const ScanTrack sequence = find_kitti_sequence(folder.path() / "velodyne/", {}, {});
  Scan first;
  sequence.attach(first, 0);
  EXPECT_EQ(first.stamp_ns, 0);
  ASSERT_TRUE(first.motion);
  EXPECT_EQ(first.motion->duration_ns, 103'622'400);
  expect_near(first.motion->T_world_sensor_end.translation, {2, 0, 0});
  Scan last;
  sequence.attach(last, 2);
  EXPECT_EQ(last.stamp_ns, 210'000'000);
  ASSERT_TRUE(last.motion);
  EXPECT_EQ(last.motion->T_world_sensor_begin, *last.T_world_sensor);
  // On as before: turned left by 90 degrees once more.
  EXPECT_NEAR(std::fabs(yaw_of(last.motion->T_world_sensor_end.rotation)), 3.141592653589793, 1e-9);
  Scan beyond;
  sequence.attach(beyond, 3);
  EXPECT_FALSE(beyond.stamp_ns || beyond.motion || beyond.T_world_sensor);
}

TEST(KittiSequence, WithoutTimesATenthOfASecondIsAssumedAndSaid) {
  const TemporaryFolder folder;
  folder.write("poses.txt", kPoses);
  folder.write("calib.txt", kCalib);
  Heard heard;
  const ScanTrack sequence = find_kitti_sequence(folder.path(), {}, heard.log());
  Scan scan;
  sequence.attach(scan, 0);
  ASSERT_TRUE(scan.motion);
  EXPECT_EQ(scan.motion->duration_ns, 100'000'000);
  EXPECT_FALSE(scan.stamp_ns);
  EXPECT_THAT(heard.notes, ::testing::Contains(HasSubstr("0.1 s")));
}

TEST(KittiSequence, FindsThePosesOfTheOdometryBenchmark) {
  const TemporaryFolder folder;
  folder.write("poses/07.txt", kPoses);
  folder.write("sequences/07/calib.txt", kCalib);
  EXPECT_EQ(find_kitti_sequence(folder.path() / "sequences/07/velodyne", {}, {}).T_world_sensor.size(), 3U);
}

TEST(KittiSequence, ReadsTheTimesOfRawDrives) {
  const TemporaryFolder folder;
  folder.write("velodyne_points/timestamps.txt",
               "2011-09-26 13:02:25.594360375\n2011-09-26 13:02:25.697895000\n");
  const auto sequence = find_kitti_sequence(folder.path() / "velodyne_points/data", {}, {});
  EXPECT_THAT(sequence.stamps_ns, ElementsAre(1'317'042'145'594'360'375, 1'317'042'145'697'895'000));
}

TEST(KittiSequence, WhatCannotBeUsedIsSaidAndLeftOut) {
  const std::vector<std::pair<std::string, std::string>> bad{
      {"1 0 0 0 0 1 0 0 0 0 1\n", kCalib},      // 11 numbers
      {"1 0 0 0 0 1 0 0 0 0 1 0 0\n", kCalib},  // 13
      {"2 0 0 0 0 1 0 0 0 0 1 0\n", kCalib},    // no rotation
      {"1 0 0 nan 0 1 0 0 0 0 1 0\n", kCalib},
      {kPoses, "P0: 1\n"},  // no Tr
      {kPoses, "Tr: 1 2 3\n"}};
  for (const auto& [poses, calib] : bad) {
    const TemporaryFolder folder;
    folder.write("poses.txt", poses);
    folder.write("calib.txt", calib);
    Heard heard;
    EXPECT_THAT(find_kitti_sequence(folder.path(), {}, heard.log()).T_world_sensor, IsEmpty())
        << poses << calib;
    EXPECT_EQ(heard.warnings.size(), 1U) << poses << calib;
  }
  const TemporaryFolder folder;
  folder.write("poses.txt", kPoses);
  Heard heard;
  EXPECT_THAT(find_kitti_sequence(folder.path(), {}, heard.log()).T_world_sensor, IsEmpty());
  EXPECT_THAT(heard.warnings, ElementsAre(HasSubstr("calib.txt")));
}

TEST(KittiSequence, TimesAndPosesOfDifferentLengthAreNotUsed) {
  const TemporaryFolder folder;
  folder.write("poses.txt", kPoses);
  folder.write("calib.txt", kCalib);
  folder.write("times.txt", "0\n0.1\n");
  Heard heard;
  const ScanTrack sequence = find_kitti_sequence(folder.path(), {}, heard.log());
  EXPECT_THAT(sequence.stamps_ns, IsEmpty());
  EXPECT_THAT(sequence.T_world_sensor, IsEmpty());
  EXPECT_EQ(heard.warnings.size(), 1U);
}

TEST(KittiRows, AreTheNumbersOfTheNamesOrThePlaces) {
  EXPECT_THAT(kitti_rows({"a/000003.bin", "a/000007.bin"}, 8), ElementsAre(3U, 7U));
  EXPECT_THAT(kitti_rows({"a.bin", "b.bin"}, 2), ElementsAre(0U, 1U));
  EXPECT_THAT(kitti_rows({"100.bin", "101.bin"}, 2), ElementsAre(0U, 1U));
  EXPECT_THAT(kitti_rows({"a.bin", "b.bin"}, 3), IsEmpty());
  EXPECT_THAT(kitti_rows({"000003.bin"}, 0), IsEmpty());
}

TEST(ParseDateTime, IsUtc) {
  EXPECT_EQ(parse_date_time("1970-01-01 00:00:00"), 0);
  EXPECT_EQ(parse_date_time("2000-02-29 23:59:59.25"), 951'868'799'250'000'000);
  EXPECT_EQ(parse_date_time("2261-12-31 23:59:59"), 9'214'646'399'000'000'000);
  for (const char* text :
       {"2011-02-29 00:00:00", "2011-13-01 00:00:00", "2011-01-01 24:00:00", "2011-01-01 00:60:00",
        "2011-01-01", "2011-01-01 00:00:00.", "2011-01-01 00:00:00x", "2011-01-01T00:00:00",
        "0011-09-26 13:02:25", "2262-01-01 00:00:00", ""}) {
    EXPECT_FALSE(parse_date_time(text)) << text;
  }
}

}  // namespace verge::io
