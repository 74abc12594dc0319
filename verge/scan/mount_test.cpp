// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/scan/mount.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include <gtest/gtest.h>

#include "verge/core/angle.hpp"
#include "verge/scan/organise.hpp"
#include "verge/scan/test_clouds.hpp"

namespace verge {
namespace {

constexpr double kSidewalk = 0.15;

/// Distance along a ray from a sensor at (0, 0, height) to a straight road 6 m wide along +x with kerbs,
/// sidewalks, and walls behind.
double cast(Vec3 direction, double height) {
  constexpr double kHalfWidth = 3.0;
  constexpr double kWall = 6.0;
  constexpr double kFar = 80.0;
  double best = kFar;
  const auto hit = [&](double t, bool valid) {
    if (t > 0.0 && valid) best = std::min(best, t);
  };
  const double lateral = std::abs(direction.y);
  const double to_road = -height / direction.z;
  hit(to_road, lateral * to_road < kHalfWidth);
  const double to_sidewalk = (kSidewalk - height) / direction.z;
  hit(to_sidewalk, lateral * to_sidewalk >= kHalfWidth);
  const double to_kerb = kHalfWidth / lateral;
  const double z = height + direction.z * to_kerb;
  hit(to_kerb, z >= 0.0 && z <= kSidewalk);
  hit(kWall / lateral, height + direction.z * kWall / lateral > kSidewalk);
  return best;
}

/// What a sensor of 32 rings sees from that mount.
Scan see(const Mount& mount) {
  const LevelFrame frame(mount);
  const Vec3 origin = frame.to_level({});
  Cloud cloud;
  for (int ring = 0; ring < 32; ++ring) {
    const double elevation = deg_to_rad(-30.0 + ring * 4.0 / 3.0);
    for (int i = 0; i < 1800; ++i) {
      const double azimuth = deg_to_rad(-179.9 + 0.2 * i);
      const Vec3 ray{std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth),
                     std::sin(elevation)};
      const double t = cast(frame.to_level(ray) - origin, mount.height_m);
      if (t > 70.0) continue;
      cloud.x.push_back(static_cast<float>(t * ray.x));
      cloud.y.push_back(static_cast<float>(t * ray.y));
      cloud.z.push_back(static_cast<float>(t * ray.z));
      cloud.ring.push_back(ring);
    }
  }
  return organise(std::move(cloud)).scan;
}

TEST(LevelFrame, BackIsTheInverse) {
  const LevelFrame frame({1.8, 0.1, -0.05, 0.3});
  const Vec3 p{3.0, -2.0, 0.7};
  EXPECT_LT(norm(frame.to_sensor(frame.to_level(p)) - p), 1e-12);
}

TEST(LevelFrame, AnglesHaveTheirStatedSigns) {
  EXPECT_LT(LevelFrame({0.0, 0.1, 0.0, 0.0}).to_level({1.0, 0.0, 0.0}).z, 0.0);  // nose down
  EXPECT_GT(LevelFrame({0.0, 0.0, 0.1, 0.0}).to_level({0.0, 1.0, 0.0}).z, 0.0);  // left side up
  const Vec3 ahead = LevelFrame({0.0, 0.0, 0.0, 0.2}).to_level({std::cos(0.2), std::sin(0.2), 0.0});
  EXPECT_NEAR(ahead.y, 0.0, 1e-12);  // the road ahead lies on +x
  EXPECT_DOUBLE_EQ(LevelFrame({1.5, 0.0, 0.0, 0.0}).to_level({}).z, 1.5);
}

struct MountCase {
  const char* name;
  Mount mount;
};

class MountOf : public ::testing::TestWithParam<MountCase> {};

TEST_P(MountOf, IsFoundFromTheScanAlone) {
  const Mount& truth = GetParam().mount;
  const MountEstimate estimate = estimate_mount(see(truth));
  EXPECT_TRUE(estimate.plane_found);
  EXPECT_TRUE(estimate.heading_found);
  EXPECT_NEAR(estimate.mount.height_m, truth.height_m, 0.01);
  EXPECT_NEAR(estimate.mount.pitch_rad, truth.pitch_rad, deg_to_rad(0.1));
  EXPECT_NEAR(estimate.mount.roll_rad, truth.roll_rad, deg_to_rad(0.1));
  EXPECT_NEAR(estimate.mount.forward_rad, truth.forward_rad, deg_to_rad(0.1));
}

INSTANTIATE_TEST_SUITE_P(
    Sensors, MountOf,
    ::testing::Values(MountCase{"Level", {1.84, 0.0, 0.0, 0.0}},
                      MountCase{"LowAndRolled", {0.68, 0.0, deg_to_rad(2.0), 0.0}},
                      MountCase{"NoseDown", {1.9, deg_to_rad(5.0), 0.0, 0.0}},
                      MountCase{"TiltedBothWays", {2.5, deg_to_rad(-4.0), deg_to_rad(3.0), 0.0}},
                      MountCase{"TurnedLeft", {1.84, 0.0, 0.0, deg_to_rad(10.0)}},
                      MountCase{"TurnedRightAndTilted",
                                {1.73, deg_to_rad(1.0), deg_to_rad(-2.0), deg_to_rad(-25.0)}}),
    [](const auto& instance) { return std::string(instance.param.name); });

TEST(EstimateMount, WhatIsKnownStaysToTheLastBitAndTheRestIsFound) {
  const Mount truth{1.84, deg_to_rad(2.0), deg_to_rad(-1.0), 0.0};
  const Scan scan = see(truth);
  MountHint hint;
  hint.pitch_rad = truth.pitch_rad;
  hint.height_m = truth.height_m;
  const MountEstimate estimate = estimate_mount(scan, hint);
  EXPECT_EQ(estimate.mount.pitch_rad, truth.pitch_rad);
  EXPECT_EQ(estimate.mount.height_m, truth.height_m);
  EXPECT_NEAR(estimate.mount.roll_rad, truth.roll_rad, deg_to_rad(0.1));
}

TEST(EstimateMount, MirroringTheWorldMirrorsTheMount) {
  Scan scan = see({1.84, deg_to_rad(1.0), deg_to_rad(2.0), deg_to_rad(7.0)});
  const Mount mount = estimate_mount(scan).mount;
  Cloud cloud = flatten(scan);
  for (float& y : cloud.y) y = -y;
  const Mount mirrored = estimate_mount(organise(std::move(cloud)).scan).mount;
  EXPECT_NEAR(mirrored.height_m, mount.height_m, 1e-6);
  EXPECT_NEAR(mirrored.pitch_rad, mount.pitch_rad, 1e-6);
  EXPECT_NEAR(mirrored.roll_rad, -mount.roll_rad, 1e-6);
  EXPECT_NEAR(mirrored.forward_rad, -mount.forward_rad, 1e-6);
}

TEST(EstimateMount, IsDefinedWhereNothingIsSeen) {
  const MountEstimate estimate = estimate_mount(Scan{});
  EXPECT_FALSE(estimate.plane_found);
  EXPECT_FALSE(estimate.heading_found);
  EXPECT_EQ(estimate.mount, Mount{});
}

/// A real set and the height at which its sensor is known to stand.
struct RealSet {
  const char* folder;
  const char* suffix;
  double height_m;
};

class RealMount : public ::testing::TestWithParam<RealSet> {};

Cloud read(const RealSet& set, const std::filesystem::path& file) {
  if (std::string(set.suffix) == ".pcd.bin") return testing::read_nuscenes(file);
  if (std::string(set.suffix) == ".bin") return testing::read_kitti(file);
  return testing::read_pcd(file, 18, 16);
}

TEST_P(RealMount, HeightIsFoundWithin10Centimetres) {
  if (!testing::data_folder()) GTEST_SKIP() << "VERGE_DATA is not set: no real scans";
  const auto files = testing::files_in(*testing::data_folder() / GetParam().folder, GetParam().suffix);
  ASSERT_FALSE(files.empty());
  for (const auto& file : files) {
    const MountEstimate estimate = estimate_mount(organise(read(GetParam(), file)).scan);
    EXPECT_TRUE(estimate.plane_found) << file;
    EXPECT_NEAR(estimate.mount.height_m, GetParam().height_m, 0.1) << file;
    EXPECT_LT(std::abs(estimate.mount.pitch_rad), deg_to_rad(5.0)) << file;
    EXPECT_LT(std::abs(estimate.mount.roll_rad), deg_to_rad(5.0)) << file;
  }
}

// A search that samples headings would prefer now this, now that one of two near-equal directions.
TEST_P(RealMount, TurningTheVehicleTurnsTheForwardAxisAlone) {
  if (!testing::data_folder()) GTEST_SKIP() << "VERGE_DATA is not set: no real scans";
  const auto files = testing::files_in(*testing::data_folder() / GetParam().folder, GetParam().suffix);
  ASSERT_FALSE(files.empty());
  const double angle = deg_to_rad(3.7);
  for (const auto& file : files) {
    const Cloud cloud = read(GetParam(), file);
    const Mount mount = estimate_mount(organise(cloud).scan).mount;
    const Mount turned = estimate_mount(organise(testing::turned(cloud, angle)).scan).mount;
    EXPECT_NEAR(turned.forward_rad, mount.forward_rad + angle, deg_to_rad(0.05)) << file;
    EXPECT_NEAR(turned.height_m, mount.height_m, 0.001) << file;
  }
}

INSTANTIATE_TEST_SUITE_P(Sets, RealMount,
                         ::testing::Values(RealSet{"nuscenes-hdl32/labelled/LIDAR_TOP", ".pcd.bin", 1.84},
                                           RealSet{"semantickitti/sequences/00/velodyne", ".bin", 1.73},
                                           RealSet{"vlp16-kerb-labels", ".pcd", 0.68}),
                         [](const auto& instance) { return "Set" + std::to_string(instance.index); });

}  // namespace
}  // namespace verge
