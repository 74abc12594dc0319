// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/io/nuscenes_tables.hpp"

#include <cmath>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "verge/core/angle.hpp"
#include "verge/io/source.hpp"
#include "verge/io/test_files.hpp"

namespace verge::io {
namespace {

using ::testing::HasSubstr;
using testing::TemporaryFolder;

const std::string kFirst = "n015__LIDAR_TOP__1532402927647951.pcd.bin";
const std::string kSecond = "n015__LIDAR_TOP__1532402928147847.pcd.bin";

/// 30 points of one ring, 10 m ahead: x right, y forward.
std::string one_ring() {
  std::vector<float> values;
  for (int i = 0; i < 30; ++i)
    values.insert(values.end(), {0.1F * static_cast<float>(i), 10.0F, -1.0F, 5.0F, 3.0F});
  return testing::floats(values);
}

/// Two scans: the vehicle stands at (600, 1600) and drives 5 m east; the lidar stands 1 m ahead of its
/// origin, 1.84 m up, and its y axis points ahead.
std::filesystem::path data_set(const TemporaryFolder& folder) {
  folder.write("samples/LIDAR_TOP/" + kFirst, one_ring());
  folder.write("samples/LIDAR_TOP/" + kSecond, one_ring());
  folder.write(
      "v1.0-mini/sample_data.json",
      R"([{"token": "a", "ego_pose_token": "e1", "calibrated_sensor_token": "c", "height": 0, "prev": "",
"is_key_frame": true, "filename": "samples/LIDAR_TOP/)" +
          kFirst + R"("},
{"token": "x", "ego_pose_token": "ex", "calibrated_sensor_token": "cx", "filename": "samples/CAM_BACK/n015.jpg"},
{"token": "b", "ego_pose_token": "e2", "calibrated_sensor_token": "c", "filename": "samples/LIDAR_TOP/)" +
          kSecond + "\"}]");
  folder.write(
      "v1.0-mini/ego_pose.json",
      R"([{"token": "e2", "timestamp": 2, "rotation": [1, 0, 0, 0], "translation": [605.0, 1600.0, 0]},
{"token": "ex", "rotation": [1, 0, 0, 0], "translation": [0, 0, 0]},
{"token": "e1", "timestamp": 1, "rotation": [1, 0, 0, 0], "translation": [600.0, 1600.0, 0]}])");
  folder.write("v1.0-mini/calibrated_sensor.json",
               R"([{"token": "c", "sensor_token": "s", "translation": [1.0, 0.0, 1.84],
"rotation": [0.7071067811865476, 0, 0, -0.7071067811865476], "camera_intrinsic": [[1, 2], [3, 4]]}])");
  return folder.path() / "samples/LIDAR_TOP";
}

}  // namespace

TEST(NuscenesTables, TheNameSaysTheTime) {
  EXPECT_EQ(nuscenes_stamp_ns("a/" + kFirst), 1'532'402'927'647'951'000);
  for (const char* name : {"000001.pcd.bin", "n__LIDAR_TOP__x.pcd.bin", "n__99999999999999999999.pcd.bin"}) {
    EXPECT_FALSE(nuscenes_stamp_ns(name)) << name;
  }
}

TEST(NuscenesTables, ScansHaveTheirTimesAndThePosesOfTheTurnedFrame) {
  const TemporaryFolder folder;
  const auto source = open(data_set(folder));
  ASSERT_TRUE(source) << to_string(source.error());
  const auto scan = (*source)->next();
  ASSERT_TRUE(scan && *scan);
  EXPECT_EQ((*scan)->stamp_ns, 1'532'402'927'647'951'000);
  ASSERT_TRUE((*scan)->T_world_sensor);
  // Ours looks ahead along the vehicle: east.
  const Pose& pose = *(*scan)->T_world_sensor;
  EXPECT_NEAR(yaw_of(pose.rotation), 0.0, 1e-9);
  const Vec3 ahead = pose * Vec3{10.0, 0.0, -1.84};
  EXPECT_NEAR(ahead.x, 611.0, 1e-9);
  EXPECT_NEAR(ahead.y, 1600.0, 1e-9);
  EXPECT_NEAR(ahead.z, 0.0, 1e-9);
  ASSERT_TRUE((*scan)->motion);
  EXPECT_EQ((*scan)->motion->duration_ns, 499'896'000);
  EXPECT_NEAR((*scan)->motion->T_world_sensor_end.translation.x, 606.0, 1e-9);
}

TEST(NuscenesTables, OtherFramesOrderAndTablesAreLeftAlone) {
  const TemporaryFolder folder;
  const auto scans = data_set(folder);
  std::vector<std::string> warnings;
  const Log log = [&](LogLevel level, std::string_view text) {
    if (level == LogLevel::kWarning) warnings.emplace_back(text);
  };
  EXPECT_TRUE(find_nuscenes_track({scans / "000001.pcd.bin"}, log).stamps_ns.empty());
  EXPECT_TRUE(warnings.empty());

  folder.write("v1.0-mini/ego_pose.json",
               R"([{"token": "e1", "rotation": [1, 0, 0, 0], "translation": [6, 1, 0]}])");
  const ScanTrack track = find_nuscenes_track({scans / kFirst, scans / kSecond}, log);
  EXPECT_EQ(track.stamps_ns.size(), 2U);
  EXPECT_TRUE(track.T_world_sensor.empty());
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_THAT(warnings[0], HasSubstr("no pose of " + kSecond));

  for (const char* broken :
       {"", "[{", "[{\"token\": \"e1\", \"rotation\": [2, 0, 0, 0], \"translation\": [6, 1, 0]}]"}) {
    folder.write("v1.0-mini/ego_pose.json", broken);
    EXPECT_TRUE(find_nuscenes_track({scans / kFirst}, log).T_world_sensor.empty()) << broken;
  }
  EXPECT_EQ(warnings.size(), 4U);
}

}  // namespace verge::io
