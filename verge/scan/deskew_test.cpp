// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "verge/scan/organise.hpp"

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

}  // namespace verge
