// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/sensor/velodyne/calibration.hpp"

#include <functional>

#include <fmt/core.h>
#include <gtest/gtest.h>

namespace verge::sensor::velodyne {
namespace {

Expected<Calibration> read(const std::string& text, std::size_t lasers = 32) {
  return read_calibration(std::as_bytes(std::span(text)), "db.yaml", lasers);
}

using LaserText = std::function<std::string(int)>;

std::string flow(const LaserText& laser, int count) {
  std::string text = "lasers:\n";
  for (int i = 0; i < count; ++i) text += fmt::format("- {{{}}}\n", laser(i));
  return text + fmt::format("num_lasers: {}\ndistance_resolution: 0.002\n", count);
}

std::string plain(int id) {
  return fmt::format("dist_correction: 0.{}, laser_id: {}, rot_correction: {},\n  vert_correction: {}", id,
                     id, 0.01 * id, -0.5 + 0.02 * id);
}

TEST(VelodyneCalibration, FlowStyleAsTheDriversHaveIt) {
  const auto calibration = read(flow(plain, 32));
  ASSERT_TRUE(calibration) << to_string(calibration.error());
  EXPECT_DOUBLE_EQ((*calibration)[5].elevation_rad, -0.4);
  EXPECT_DOUBLE_EQ((*calibration)[5].azimuth_rad, -0.05) << "the file counts against the turn";
  EXPECT_DOUBLE_EQ((*calibration)[5].distance_m, 0.5);
}

TEST(VelodyneCalibration, BlockStyleCommentsAndOtherKeys) {
  std::string text = "# of sensor 12\ndistance_resolution: 0.002\nlasers:\n";
  for (int i = 0; i < 64; ++i) {
    text += fmt::format(
        "- dist_correction: 1.2 # metres\n  dist_correction_x: 1.3\n  dist_correction_y: 1.4\n"
        "  focal_slope: 0.7\n  laser_id: {}\n  two_pt_correction_available: {}\n"
        "  vert_correction: {}\n  vert_offset_correction: 0.2\n  horiz_offset_correction: -0.026\n",
        i, i == 3, 0.001 * i);
  }
  text += "num_lasers: 64\nstatus:\n  Model: S3\n";
  const auto calibration = read(text, 64);
  ASSERT_TRUE(calibration) << to_string(calibration.error());
  EXPECT_DOUBLE_EQ((*calibration)[3].up_m, 0.2);
  EXPECT_DOUBLE_EQ((*calibration)[3].left_m, -0.026);
  ASSERT_TRUE((*calibration)[3].near);
  EXPECT_DOUBLE_EQ((*calibration)[3].near->side_m, 1.3);
  EXPECT_DOUBLE_EQ((*calibration)[3].near->ahead_m, 1.4);
  EXPECT_FALSE((*calibration)[4].near);
}

struct Fault {
  std::string name;
  std::string text;
  ErrorCode code;
  std::string says;
};

TEST(VelodyneCalibration, V20EveryFaultIsNamed) {
  const auto with = [](int at, const std::string& laser, int count = 32) {
    return flow([&](int i) { return i == at ? laser : plain(i); }, count);
  };
  const Fault faults[] = {
      {"31 lasers", flow(plain, 31), ErrorCode::kUsage, "another sensor"},
      {"33 lasers", flow(plain, 33), ErrorCode::kUsage, "another sensor"},
      {"duplicate id", with(7, "laser_id: 6, vert_correction: 0.9"), ErrorCode::kUnusable, "twice"},
      {"id -1", with(7, "laser_id: -1, vert_correction: 0.9"), ErrorCode::kUnusable, "no such laser_id"},
      {"id too great", with(7, "laser_id: 32, vert_correction: 0.9"), ErrorCode::kUnusable,
       "no such laser_id"},
      {"id not whole", with(7, "laser_id: 7.5, vert_correction: 0.9"), ErrorCode::kUnusable,
       "no such laser_id"},
      {"no id", with(7, "vert_correction: 0.9"), ErrorCode::kUnusable, "missing"},
      {"NaN angle", with(7, "laser_id: 7, vert_correction: nan"), ErrorCode::kUnusable, "finite"},
      {"infinite angle", with(7, "laser_id: 7, vert_correction: -inf"), ErrorCode::kUnusable, "finite"},
      {"word", with(7, "laser_id: 7, vert_correction: low"), ErrorCode::kUnusable, "finite"},
      {"no value", with(7, "laser_id: 7, vert_correction:"), ErrorCode::kUnusable, "finite"},
      {"two equal angles", with(7, "laser_id: 7, vert_correction: -0.5"), ErrorCode::kUnusable, "same vert"},
      {"no key", with(7, "laser_id: 7, nonsense"), ErrorCode::kUnusable, "not a key"},
      {"empty", "", ErrorCode::kUnusable, "no lasers"},
      {"other file", "a: 1\nb: 2\n", ErrorCode::kUnusable, "no lasers"},
      {"too long", std::string((1U << 20U) + 1, ' '), ErrorCode::kUnusable, "too long"},
      {"too many", flow(plain, 200), ErrorCode::kUnusable, "too many"},
  };
  for (const Fault& fault : faults) {
    const auto calibration = read(fault.text);
    ASSERT_FALSE(calibration) << fault.name;
    EXPECT_EQ(calibration.error().code, fault.code) << fault.name;
    EXPECT_NE(calibration.error().what.find(fault.says), std::string::npos)
        << fault.name << ": " << to_string(calibration.error());
    EXPECT_NE(calibration.error().where.find(':'), std::string::npos) << fault.name;
  }
}

TEST(VelodyneCalibration, AnErrorNamesItsLine) {
  const auto calibration =
      read("lasers:\n- {laser_id: 0, vert_correction: 0}\n- {laser_id: 1, vert_correction: x}\n", 2);
  ASSERT_FALSE(calibration);
  EXPECT_EQ(calibration.error().where.substr(0, 2), "3:");
}

TEST(VelodyneCalibration, EveryCutOfAFileIsReadOrRefusedInOrder) {
  const std::string whole = flow(plain, 32);
  for (std::size_t length = 0; length <= whole.size(); ++length) {
    const auto calibration = read(whole.substr(0, length));
    if (!calibration) continue;
    EXPECT_EQ(calibration->size(), 32U) << length;
  }
}

}  // namespace
}  // namespace verge::sensor::velodyne
