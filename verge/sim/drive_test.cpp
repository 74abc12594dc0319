// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/sim/drive.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <tuple>
#include <vector>

#include <gtest/gtest.h>

#include "verge/core/angle.hpp"
#include "verge/core/polyline.hpp"

namespace verge::sim {
namespace {

constexpr auto kCurbLabel = static_cast<std::uint32_t>(Surface::kCurb);
constexpr auto kRoadLabel = static_cast<std::uint32_t>(Surface::kRoad);
constexpr auto kWallLabel = static_cast<std::uint32_t>(Surface::kWall);

// Without noise and with exact ranges: what remains is geometry.
DriveConfig exact(DriveConfig config) {
  config.noise.range_sigma_m = 0.0;
  config.noise.dropout_at_range_max = 0.0;
  config.sensor.range_resolution_m = 0.0;
  return config;
}

// The level frame as scan/mount.hpp defines it, written out once more.
Vec3 level(const Mount& mount, Vec3 p_sensor) {
  const Quaternion tilt = from_yaw_pitch_roll(-mount.forward_rad, mount.pitch_rad, mount.roll_rad);
  return rotate(tilt, p_sensor) + Vec3{0.0, 0.0, mount.height_m};
}

std::vector<Vec2> line_of(const Boundary& boundary) {
  std::vector<Vec2> line;
  for (const Vec3& p : boundary.points) line.push_back(p.xy());
  return line;
}

double distance_to_truth(const Scene& truth, Vec2 p) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const Boundary& boundary : truth.boundaries) {
    nearest = std::min(nearest, distance_to(line_of(boundary), p));
  }
  return nearest;
}

TEST(Drive, StandingStillTheKerbsReturnsLieOnTheTruth) {
  for (DriveConfig config : {exact(straight_road()), exact(curved_road())}) {
    config.course.speed_mps = 0.0;
    const Simulated s = Drive(config).scan(0);
    std::size_t faces = 0;
    for (std::size_t i = 0; i < s.scan.size(); ++i) {
      const Vec2 p = s.scan.point(i).xy();
      if (s.scan.label[i] != kCurbLabel || norm(p) > 25.0) continue;
      // 12 cm of height times the tilt of the mount, and the mesh's chords.
      EXPECT_LT(distance_to_truth(s.truth, p), 0.003);
      ++faces;
    }
    EXPECT_GT(faces, 300U);
  }
}

TEST(Drive, TheMountTurnsReturnsOfALevelRoadIntoHeightZero) {
  DriveConfig config = exact(straight_road());
  config.road.cross_fall = 0.0;
  config.mount = {.height_m = 1.73, .pitch_rad = 0.03, .roll_rad = -0.02, .forward_rad = 0.4};
  config.course.heading_offset_rad = deg_to_rad(7.0);
  const Simulated s = Drive(config).scan(0);
  EXPECT_NEAR(s.mount.forward_rad, 0.4 - deg_to_rad(7.0), 1e-12);
  std::size_t on_road = 0;
  for (std::size_t i = 0; i < s.scan.size(); ++i) {
    if (s.scan.label[i] != kRoadLabel) continue;
    EXPECT_NEAR(level(s.mount, s.scan.point(i)).z, 0.0, 1e-4);
    ++on_road;
  }
  EXPECT_GT(on_road, 5000U);
}

TEST(Drive, TheMountsForwardAxisRunsAlongTheKerbs) {
  DriveConfig config = exact(straight_road());
  config.mount.forward_rad = 1.2;
  config.course.heading_offset_rad = deg_to_rad(-9.0);
  const Simulated s = Drive(config).scan(0);
  for (const Boundary& boundary : s.truth.boundaries) {
    const double y = boundary.side == Side::kLeft ? 4.0 : -4.0;
    for (const Vec3& p : boundary.points) EXPECT_NEAR(level(s.mount, p).y, y, 1e-9);
  }
}

TEST(Drive, InTheRightHandLaneTheVehicleRollsWithTheCrossFall) {
  DriveConfig config = straight_road();
  config.course.lateral_m = -2.0;
  config.mount = {.height_m = 1.9};
  const Pose T_world_sensor = Drive(config).T_world_sensor(0);
  const Vec3 left = rotate(T_world_sensor.rotation, {0.0, 1.0, 0.0});
  EXPECT_NEAR(left.z / left.y, 0.02, 1e-4);  // its left side stands on the higher, inner part of the road
  EXPECT_NEAR(T_world_sensor.translation.z, 1.9 - 0.04, 1e-3);
}

// Greatest distance of the returns of the wall ahead from that wall, in world coordinates.
double wall_error(const Scan& scan, const Pose& T_world_sensor, double wall_x) {
  double worst = 0.0;
  for (std::size_t i = 0; i < scan.size(); ++i) {
    if (scan.label[i] != kWallLabel) continue;
    worst = std::max(worst, std::fabs((T_world_sensor * scan.point(i)).x - wall_x));
  }
  return worst;
}

TEST(Deskew, AScanAt60KilometresAnHourAgreesWithTheStaticWorld) {
  World world;
  add_quad(world, {40, -60, -5}, {40, 60, -5}, {40, 60, 20}, {40, -60, 20}, Surface::kWall);
  const Caster caster(std::move(world));
  const double speed = 60.0 / 3.6;
  const Trajectory driving = [=](std::int64_t ns) {
    const double t = 1e-9 * static_cast<double>(ns);
    return Pose{from_yaw_pitch_roll(0.2 * t, 0.0, 0.0), {speed * t, 0.0, 1.9}};
  };
  const DriveConfig config = exact(straight_road());
  const Scan skewed = simulate_revolution(caster, config.sensor, driving, 0, config.noise);
  const Pose T_world_sensor = *skewed.T_world_sensor;
  EXPECT_GT(wall_error(skewed, T_world_sensor, 40.0), 0.5 * speed * 0.1);
  EXPECT_LT(wall_error(deskew(skewed), T_world_sensor, 40.0), 1e-4);
}

// Greatest distance of the near kerb's returns from the truth.
double curb_error(const Scan& scan, const Scene& truth) {
  double worst = 0.0;
  for (std::size_t i = 0; i < scan.size(); ++i) {
    const Vec2 p = scan.point(i).xy();
    if (scan.label[i] != kCurbLabel || norm(p) > 15.0) continue;
    worst = std::max(worst, distance_to_truth(truth, p));
  }
  return worst;
}

TEST(Deskew, At60KilometresAnHourTheKerbsOfACurveAheadComeBackOntoTheTruth) {
  DriveConfig config = exact(curved_road());
  config.course.speed_mps = 60.0 / 3.6;
  config.course.start_m =
      58.0;  // still straight at the scan's end, 1.67 m on: within it the motion is uniform
  const Simulated s = Drive(config).scan(0);
  EXPECT_GT(curb_error(s.scan, s.truth), 0.2);
  EXPECT_LT(curb_error(deskew(s.scan), s.truth), 0.003);
}

TEST(Deskew, InACurveTheStraightMotionThatItAssumesIsOffByTheArcsSagitta) {
  DriveConfig config = exact(curved_road());
  config.course.speed_mps = 60.0 / 3.6;
  const Simulated s = Drive(config).scan(0);
  EXPECT_LT(curb_error(deskew(s.scan), s.truth), 0.012 + 0.003);  // 1.67 m squared over 8 times 30 m
}

TEST(DemoDrive, IsStraightForSixtyMetresAheadAndThenCurves) {
  const Drive drive(demo_drive());
  EXPECT_TRUE(drive.road().is_straight(40.0, 100.0));
  EXPECT_FALSE(drive.road().is_straight(100.0, 101.0));
  EXPECT_TRUE(drive.scan(0).straight);
  EXPECT_TRUE(drive.scan(55).straight);    // 84 m: 16 m before the curve
  EXPECT_FALSE(drive.scan(58).straight);   // 86.4 m
  EXPECT_FALSE(drive.scan(100).straight);  // in the curve
}

TEST(ReadyDrives, AreLongEnoughForTheirTravel) {
  for (const double travel : {0.0, 10.0, 100.0, 1000.0}) {
    for (const DriveConfig& config :
         std::vector<DriveConfig>{straight_road(travel), curved_road(travel), demo_drive(travel)}) {
      EXPECT_GE(Road(config.road).length_m(), config.course.start_m + travel + 60.0);
    }
  }
}

TEST(ReadyDrives, AreStraightOrCurvedAllAlongTheWay) {
  const Road straight(straight_road(500.0).road);
  EXPECT_TRUE(straight.is_straight(0.0, straight.length_m()));
  const DriveConfig config = curved_road(500.0);
  const Road curved(config.road);
  for (double s = config.course.start_m; s < config.course.start_m + 500.0; s += 1.0) {
    EXPECT_FALSE(curved.is_straight(s - 0.5, s + 0.5)) << s;
  }
}

TEST(ReadyDrives, NeverCrossTheirOwnRoad) {
  for (const DriveConfig& config : std::vector<DriveConfig>{curved_road(1000.0), demo_drive(1000.0)}) {
    const Road road(config.road);
    for (double a = 0.0; a < road.length_m(); a += 5.0) {
      for (double b = a + 60.0; b < road.length_m(); b += 5.0) {
        EXPECT_GT(distance(road.at(a).position, road.at(b).position), 30.0) << a << " and " << b;
      }
    }
  }
}

TEST(ReadyDrives, RefuseATravelThatCannotBe) {
  EXPECT_THROW((void)straight_road(-1.0), std::invalid_argument);
  EXPECT_THROW((void)curved_road(std::numeric_limits<double>::infinity()), std::invalid_argument);
  EXPECT_THROW((void)demo_drive(std::numeric_limits<double>::quiet_NaN()), std::invalid_argument);
}

TEST(DemoDrive, ScansAreTheSameInAnyOrder) {
  const Drive drive(demo_drive());
  const auto key = [](const Simulated& s) {
    return std::tuple(s.scan.frame, s.scan.stamp_ns, s.scan.x, s.scan.y, s.scan.z);
  };
  const auto third = key(drive.scan(3));
  const auto first = key(drive.scan(0));
  EXPECT_EQ(key(drive.scan(0)), first);
  EXPECT_EQ(key(Drive(demo_drive()).scan(3)), third);
  EXPECT_EQ(std::get<0>(third), "000003");
}

TEST(DemoDrive, SeesKerbsOnBothSides) {
  const Simulated s = Drive(demo_drive()).scan(0);
  std::size_t left = 0;
  std::size_t right = 0;
  for (std::size_t i = 0; i < s.scan.size(); ++i) {
    if (s.scan.label[i] != kCurbLabel) continue;
    (s.scan.y[i] > 0.0F ? left : right) += 1;
  }
  EXPECT_GT(left, 100U);
  EXPECT_GT(right, 100U);
  EXPECT_EQ(s.truth.frame, s.scan.frame);
  EXPECT_EQ(s.truth.stamp_ns, s.scan.stamp_ns);
}

TEST(Drive, RefusesACourseThatCannotBe) {
  const auto refuses = [](auto change) {
    DriveConfig config = straight_road();
    change(config);
    EXPECT_THROW(Drive{config}, std::invalid_argument);
  };
  refuses([](DriveConfig& c) { c.mount.height_m = 0.0; });
  refuses([](DriveConfig& c) { c.course.speed_mps = std::numeric_limits<double>::infinity(); });
  refuses([](DriveConfig& c) { c.truth_radius_m = -1.0; });
  refuses([](DriveConfig& c) { c.road.pieces.clear(); });
}

}  // namespace
}  // namespace verge::sim
