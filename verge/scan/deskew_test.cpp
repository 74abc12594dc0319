// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "verge/scan/organise.hpp"
#include "verge/scan/test_clouds.hpp"

namespace verge {
namespace {

constexpr double kSpeed = 60.0 / 3.6;  // m/s
constexpr double kDuration = 0.1;      // s
constexpr std::size_t kAzimuths = 1800;

Motion motion_to(Pose end) {
  return {.T_world_sensor_begin = {}, .T_world_sensor_end = end, .duration_ns = 100'000'000};
}

// One ring, turning once, that sees the wall y = 5 wherever it looks left, from a sensor that moves by `end`.
Scan wall_seen_while_moving(const Pose& end) {
  constexpr double kWall = 5.0;
  Cloud cloud;
  for (std::size_t k = 0; k < kAzimuths; ++k) {
    const double t = static_cast<double>(k) / static_cast<double>(kAzimuths);
    const double azimuth = std::numbers::pi * (2.0 * t - 1.0);
    const Pose T_world_sensor = interpolate({}, end, t);
    const Vec3 ray = rotate(T_world_sensor.rotation, {std::cos(azimuth), std::sin(azimuth), -0.02});
    const double reach = (kWall - T_world_sensor.translation.y) / ray.y;
    if (ray.y < 0.05 || reach <= 0.0) continue;
    const Vec3 p = reach * Vec3{std::cos(azimuth), std::sin(azimuth), -0.02};
    cloud.x.push_back(static_cast<float>(p.x));
    cloud.y.push_back(static_cast<float>(p.y));
    cloud.z.push_back(static_cast<float>(p.z));
    cloud.ring.push_back(0);
    cloud.time_s.push_back(t * kDuration);
  }
  cloud.time_s.front() = 0.0;  // the scan began at time 0, wherever the first return was
  Scan scan = organise(std::move(cloud)).scan;
  scan.motion = motion_to(end);
  return scan;
}

// Greatest distance of a return that truly lies on the wall from it.
double worst_distance(const Scan& scan) {
  double worst = 0.0;
  for (std::size_t i = 0; i < scan.size(); ++i) {
    if (scan.input_index[i] != 0) worst = std::max(worst, std::fabs(scan.point(i).y - 5.0));
  }
  return worst;
}

}  // namespace

TEST(Deskew, WallIsStraightAgainAt60KmH) {
  // Driving at 15 degrees to the wall, so that the sensor comes 0.43 m nearer while it turns.
  const double heading = std::numbers::pi / 12.0;
  const Pose end{
      .rotation = {},
      .translation = {kSpeed * kDuration * std::cos(heading), kSpeed * kDuration * std::sin(heading), 0.0}};
  const Scan skewed = wall_seen_while_moving(end);
  ASSERT_GT(skewed.size(), 800U);
  EXPECT_GT(worst_distance(skewed), 0.2);
  EXPECT_LT(worst_distance(deskew(skewed)), 1e-4);
}

TEST(Deskew, WallIsStraightAgainWhileTurning) {
  const Pose end{.rotation = from_yaw_pitch_roll(0.1, 0.02, -0.01), .translation = {1.6, 0.1, 0.05}};
  const Scan skewed = wall_seen_while_moving(end);
  EXPECT_GT(worst_distance(skewed), 0.2);
  EXPECT_LT(worst_distance(deskew(skewed)), 1e-4);
}

TEST(Deskew, StandingStillChangesNoPoint) {
  const Pose somewhere{.rotation = from_yaw_pitch_roll(1.0, 0.1, 0.2), .translation = {100.0, -3.0, 7.0}};
  Scan scan = organise(testing::simulate(testing::plan(8, -15.0, 5.0, 90))).scan;
  scan.motion = Motion{.T_world_sensor_begin = somewhere, .T_world_sensor_end = somewhere};
  const Scan still = deskew(scan);
  EXPECT_TRUE(still.deskewed);
  EXPECT_EQ(std::tie(still.x, still.y, still.z, still.azimuth, still.range, still.input_index),
            std::tie(scan.x, scan.y, scan.z, scan.azimuth, scan.range, scan.input_index));
}

TEST(Deskew, DoneTwiceIsDoneOnce) {
  const Pose end{.rotation = from_yaw_pitch_roll(0.05, 0.0, 0.0), .translation = {1.6, 0.0, 0.0}};
  const Scan once = deskew(wall_seen_while_moving(end));
  const Scan twice = deskew(once);
  EXPECT_EQ(std::tie(once.x, once.y, once.z, once.azimuth, once.range),
            std::tie(twice.x, twice.y, twice.z, twice.azimuth, twice.range));
}

TEST(Deskew, WithoutMotionOrTimesNothingIsDone) {
  const Pose end{.rotation = {}, .translation = {1.6, 0.0, 0.0}};
  const Scan scan = wall_seen_while_moving(end);
  Scan unmoved = scan;
  unmoved.motion.reset();
  Scan timeless = scan;
  timeless.time_offset_ns.clear();
  Scan instant = scan;
  instant.motion->duration_ns = 0;
  for (const Scan& unfit : {unmoved, timeless, instant}) {
    const Scan result = deskew(unfit);
    EXPECT_FALSE(result.deskewed);
    EXPECT_EQ(result.x, scan.x);
  }
}

TEST(Deskew, NoReturnsStayNoReturns) {
  Cloud cloud{.x = {0, 5}, .y = {0, 5}, .z = {0, 1}, .ring = {0, 0}, .time_s = {0.05, 0.0}};
  Scan scan = organise(cloud).scan;
  scan.motion = motion_to({.rotation = {}, .translation = {1.6, 0.0, 0.0}});
  const Scan moved = deskew(scan);
  EXPECT_EQ(moved.range[0], 0.0F);
  EXPECT_EQ(moved.point(0), Vec3{});
}

// Oracle: every point by the poses themselves, one by one.
RC_GTEST_PROP(Deskew, AgreesWithInterpolatedPoses, ()) {
  const auto milli = [] { return *rc::gen::inRange(-1500, 1500) * 1e-3; };
  const auto pose = [&] {
    return Pose{from_yaw_pitch_roll(2.0 * milli(), milli(), milli()), {20.0 * milli(), milli(), milli()}};
  };
  Scan scan = organise(testing::simulate(testing::plan(3, -15.0, 5.0, 40))).scan;
  scan.motion = Motion{.T_world_sensor_begin = pose(), .T_world_sensor_end = pose()};
  const Scan moved = deskew(scan);
  std::vector<Vec3> expected(scan.size());
  for (std::size_t i = 0; i < scan.size(); ++i) {
    const double t = scan.time_offset_ns[i] / 1e8;
    const Pose T_world_then =
        interpolate(scan.motion->T_world_sensor_begin, scan.motion->T_world_sensor_end, t);
    expected[scan.input_index[i]] =
        inverse(scan.motion->T_world_sensor_begin) * (T_world_then * scan.point(i));
  }
  for (std::size_t i = 0; i < moved.size(); ++i) {
    RC_ASSERT(norm(moved.point(i) - expected[moved.input_index[i]]) < 1e-4);
  }
}

TEST(Deskew, RingsStayWholeAndInOrder) {
  Scan scan = organise(testing::simulate(testing::plan(8, -15.0, 5.0, 360))).scan;
  scan.motion = motion_to({.rotation = from_yaw_pitch_roll(0.3, 0.0, 0.0), .translation = {1.6, 0.2, 0.0}});
  const Scan moved = deskew(scan);
  ASSERT_EQ(moved.ring_begin, scan.ring_begin);
  for (std::size_t r = 0; r < moved.ring_count(); ++r) {
    const auto begin = moved.azimuth.begin() + moved.ring_begin[r];
    EXPECT_TRUE(std::is_sorted(begin, moved.azimuth.begin() + moved.ring_begin[r + 1]));
  }
  EXPECT_EQ(flatten(moved).ring, flatten(scan).ring);
}

}  // namespace verge
