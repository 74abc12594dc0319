// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/sim/drive.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <stdexcept>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include <fmt/core.h>
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "verge/core/angle.hpp"
#include "verge/core/polyline.hpp"
#include "verge/sensor/hdl32e.hpp"
#include "verge/sim/ready.hpp"

namespace verge::sim {
namespace {

// Without noise and with exact ranges: what remains is geometry.
DriveConfig exact(const Scenario& scenario) {
  DriveConfig config;
  config.scenario = scenario;
  config.noise.range_sigma_m = 0.0;
  config.noise.dropout_at_range_max = 0.0;
  config.noise.reach = 0.0;
  config.sensor.range_resolution_m = 0.0;
  return config;
}

DriveConfig exact(std::string_view name) { return exact(ready_scenario(name)); }

DriveConfig campus() {
  DriveConfig config;
  config.scenario = ready_scenario("campus");
  return config;
}

bool shows(const Scan& scan, std::size_t i, Surface surface) {
  return (scan.label[i] & 0xFFFFU) == static_cast<std::uint32_t>(surface);
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
  for (DriveConfig config : {exact("straight"), exact("curve"), exact("crossing")}) {
    config.scenario.course.speed_mps = 0.0;
    const Simulated s = Drive(config).scan(0);
    std::size_t faces = 0;
    for (std::size_t i = 0; i < s.scan.size(); ++i) {
      const Vec2 p = s.scan.point(i).xy();
      if (!shows(s.scan, i, Surface::kCurb) || norm(p) > 25.0) continue;
      // 12 cm of height times the tilt of the mount, and the mesh's chords.
      EXPECT_LT(distance_to_truth(s.truth, p), 0.003);
      ++faces;
    }
    EXPECT_GT(faces, 300U);
  }
}

TEST(Drive, TheMountTurnsReturnsOfALevelRoadIntoHeightZero) {
  DriveConfig config = exact("straight");
  config.scenario.ground.crown = 0.0;
  config.scenario.stand = {.height_m = 1.73, .pitch_deg = 1.7, .roll_deg = -1.1, .forward_deg = 23.0};
  config.scenario.course.crab_deg = 7.0;
  const Simulated s = Drive(config).scan(0);
  EXPECT_NEAR(s.mount.forward_rad, deg_to_rad(23.0 - 7.0), 1e-12);
  std::size_t on_road = 0;
  for (std::size_t i = 0; i < s.scan.size(); ++i) {
    if (!shows(s.scan, i, Surface::kRoad)) continue;
    EXPECT_NEAR(level(s.mount, s.scan.point(i)).z, 0.0, 1e-4);
    ++on_road;
  }
  EXPECT_GT(on_road, 5000U);
}

TEST(Drive, TheMountsForwardAxisRunsAlongTheKerbs) {
  DriveConfig config = exact("straight");
  config.scenario.stand.forward_deg = 70.0;
  config.scenario.course.crab_deg = -9.0;
  const Simulated s = Drive(config).scan(0);
  for (const Boundary& boundary : s.truth.boundaries) {
    const double y = boundary.side == Side::kLeft ? 4.0 : -4.0;
    for (const Vec3& p : boundary.points) EXPECT_NEAR(level(s.mount, p).y, y, 1e-9);
  }
}

TEST(Drive, InTheRightHandLaneTheVehicleRollsWithTheCrossFall) {
  DriveConfig config = exact("straight");
  config.scenario.course.lateral_m = -2.0;
  config.scenario.stand = {.height_m = 1.9, .pitch_deg = 0.0, .roll_deg = 0.0};
  const Pose T_world_sensor = Drive(config).T_world_sensor(0);
  const Vec3 left = rotate(T_world_sensor.rotation, {0.0, 1.0, 0.0});
  EXPECT_NEAR(left.z / left.y, 0.02, 1e-4);  // its left side stands on the higher, inner part of the road
  EXPECT_NEAR(T_world_sensor.translation.z, 1.9 - 0.04, 1e-3);
}

// Greatest distance of the returns of the wall ahead from that wall, in world coordinates.
double wall_error(const Scan& scan, const Pose& T_world_sensor, double wall_x) {
  double worst = 0.0;
  for (std::size_t i = 0; i < scan.size(); ++i) {
    if (!shows(scan, i, Surface::kWall)) continue;
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
  const DriveConfig config = exact("straight");
  const Scan skewed = simulate_scan(caster, config.sensor, driving, 0, config.noise);
  const Pose T_world_sensor = *skewed.T_world_sensor;
  EXPECT_GT(wall_error(skewed, T_world_sensor, 40.0), 0.5 * speed * 0.1);
  EXPECT_LT(wall_error(deskew(skewed), T_world_sensor, 40.0), 1e-4);
}

// Greatest distance of the near kerb's returns from the truth.
double curb_error(const Scan& scan, const Scene& truth) {
  double worst = 0.0;
  for (std::size_t i = 0; i < scan.size(); ++i) {
    const Vec2 p = scan.point(i).xy();
    if (!shows(scan, i, Surface::kCurb) || norm(p) > 15.0) continue;
    worst = std::max(worst, distance_to_truth(truth, p));
  }
  return worst;
}

TEST(Deskew, At60KilometresAnHourTheKerbsOfACurveAheadComeBackOntoTheTruth) {
  DriveConfig config = exact("curve");
  config.scenario.course.speed_mps = 60.0 / 3.6;
  config.scenario.course.at_m =
      58.0;  // still straight at the scan's end, 1.67 m on: within it the motion is uniform
  const Simulated s = Drive(config).scan(0);
  EXPECT_GT(curb_error(s.scan, s.truth), 0.2);
  EXPECT_LT(curb_error(deskew(s.scan), s.truth), 0.003);
}

TEST(Deskew, InACurveTheStraightMotionThatItAssumesIsOffByTheArcsSagitta) {
  DriveConfig config = exact("curve");
  config.scenario.course.speed_mps = 60.0 / 3.6;
  const Simulated s = Drive(config).scan(0);
  EXPECT_LT(curb_error(deskew(s.scan), s.truth), 0.012 + 0.003);  // 1.67 m squared over 8 times 30 m
}

TEST(Drive, OnAClimbTheVehiclePitchesWithTheRoad) {
  DriveConfig config = exact("steep-grade");
  config.scenario.course.at_m = 120.0;
  config.scenario.course.lateral_m = 0.0;
  config.scenario.stand = {.height_m = 1.9, .pitch_deg = 0.0, .roll_deg = 0.0};
  const Pose pose = Drive(config).T_world_sensor(0);
  const Vec3 ahead = rotate(pose.rotation, {1.0, 0.0, 0.0});
  EXPECT_NEAR(ahead.z / ahead.x, 0.12, 1e-3);
}

TEST(Drive, SwervesAtSixtyDegreesASecond) {
  const Drive drive(exact("swerve"));
  const Pose a = drive.T_world_sensor(1'200'000'000);
  const Pose b = drive.T_world_sensor(1'300'000'000);
  EXPECT_NEAR(rad_to_deg(wrap_pi(yaw_of(b.rotation) - yaw_of(a.rotation))) / 0.1, 60.0, 1.0);
}

TEST(Drive, ThePosesWithinAScanAreThoseOfTheCourse) {
  for (const char* name : {"curve", "swerve", "crest"}) {
    const Drive drive(exact(name));
    const Scan scan = drive.scan(12).scan;
    const Pose end = drive.T_world_sensor(*scan.stamp_ns + scan.motion->duration_ns);
    EXPECT_LT(norm(end.translation - scan.motion->T_world_sensor_end.translation), 1e-4) << name;
    EXPECT_LT(std::fabs(wrap_pi(yaw_of(end.rotation) - yaw_of(scan.motion->T_world_sensor_end.rotation))),
              1e-4);
  }
}

TEST(Drive, TheHitsOfAMovingCarLieOnItsBoxAndCarryItsNumber) {
  DriveConfig config = exact("straight");
  config.scenario.course.speed_mps = 0.0;
  config.scenario.roads[0].items = {{.what = Thing::kVan, .at_m = 110.0, .lateral_m = 2.0, .speed_mps = 8.0}};
  const Simulated s = Drive(config).scan(3);
  ASSERT_EQ(s.truth.objects.size(), 1U);
  const Object& van = s.truth.objects[0];
  std::size_t hits = 0;
  for (std::size_t i = 0; i < s.scan.size(); ++i) {
    if (s.scan.label[i] >> 16U != 1U) continue;
    EXPECT_TRUE(shows(s.scan, i, Surface::kVehicle));
    const Vec3 p = s.scan.point(i) - van.center;
    const Vec2 along_van = {std::cos(van.yaw_rad), std::sin(van.yaw_rad)};
    EXPECT_LE(std::fabs(dot(p.xy(), along_van)), 0.5 * van.size.length_m + 0.05);
    EXPECT_LE(std::fabs(cross(along_van, p.xy())), 0.5 * van.size.width_m + 0.05);
    ++hits;
  }
  EXPECT_GT(hits, 200U);
}

TEST(Drive, ScansAreTheSameInAnyOrderAndWithAnyNumberOfThreads) {
  const Drive drive(campus());
  const auto key = [](const Simulated& s) {
    return std::tuple(s.scan.frame, s.scan.stamp_ns, s.scan.x, s.scan.y, s.scan.z, s.scan.label);
  };
  const auto third = key(drive.scan(3));
  const auto first = key(drive.scan(0));
  EXPECT_EQ(key(drive.scan(0)), first);
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  EXPECT_EQ(key(Drive(campus()).scan(3)), third);
  EXPECT_EQ(std::get<0>(third), "000003");
}

TEST(ReadyScenarios, AllCanBeDrivenAndHaveAWayOfTenScansOrMore) {
  for (const ReadyScenario& ready : ready_scenarios()) {
    SCOPED_TRACE(ready.name);
    DriveConfig config;
    config.scenario = ready.make();
    sensor::BeamModel facts = sensor::hdl32e();
    facts.firing_period_ns *= 16;  // fewer shots
    facts.block_ns *= 16;
    config.sensor = spinning_lidar(facts, config.sensor.optics);
    const Drive drive(config);
    const Simulated s = drive.scan(0);
    EXPECT_GT(s.scan.size(), 1000U);
    EXPECT_FALSE(s.truth.boundaries.empty());
    if (!drive.way_m()) continue;
    EXPECT_GT(*drive.way_m(), config.scenario.course.speed_mps);
  }
}

TEST(ReadyScenarios, AreFoundByTheirNamesAlone) {
  EXPECT_THROW((void)ready_scenario("crossings"), std::invalid_argument);
  std::set<std::string> names;
  for (const ReadyScenario& ready : ready_scenarios()) names.insert(ready.name);
  EXPECT_EQ(names.size(), ready_scenarios().size());
}

TEST(ReadyScenarios, SayTheSituationsOfPaper1) {
  for (const double radius : {0.5, 3.0, 8.0}) {
    const Scenario scenario = ready_scenario(fmt::format("paper1-r{}-v30", radius));
    EXPECT_NEAR(scenario.course.speed_mps, 30.0 / 3.6, 1e-12);
    const Land land(scenario.roads, scenario.ground);
    std::size_t corners = 0;
    for (const Mouth& mouth : land.outline().mouths) {
      const Road& branch = land.roads()[mouth.branch];
      const double width = 2.0 * branch.half_width(0.0);
      if (branch.config().driveway) {
        EXPECT_TRUE(width >= 1.0 && width <= 2.5);
        continue;
      }
      EXPECT_TRUE(width >= 4.0 && width <= 5.0);
      EXPECT_NEAR(distance(mouth.begin, mouth.end), width + 2.0 * radius, 1e-6);
      ++corners;
    }
    EXPECT_EQ(corners, 4U);
  }
}

TEST(RandomScenario, EverySeedMakesAWorldAndTheSameSeedTheSame) {
  for (std::uint64_t seed = 0; seed < 12; ++seed) {
    const Scenario scenario = random_scenario(seed);
    SCOPED_TRACE(seed);
    const Land land(scenario.roads, scenario.ground);
    const World world = land.mesh();
    EXPECT_GT(world.triangles.size(), 500U);
    if (seed > 2) continue;
    const Scenario again = random_scenario(seed);
    EXPECT_EQ(Land(again.roads, again.ground).mesh().vertices, world.vertices);
  }
}

TEST(Drive, RefusesACourseThatCannotBe) {
  const auto refuses = [](auto change) {
    DriveConfig config = exact("straight");
    change(config);
    EXPECT_THROW(Drive{config}, std::invalid_argument);
  };
  refuses([](DriveConfig& c) { c.scenario.stand.height_m = 0.0; });
  refuses([](DriveConfig& c) { c.scenario.course.speed_mps = std::numeric_limits<double>::infinity(); });
  refuses([](DriveConfig& c) { c.scenario.course.road = 2; });
  refuses([](DriveConfig& c) { c.truth_radius_m = -1.0; });
  refuses([](DriveConfig& c) { c.scenario.roads.clear(); });
}

}  // namespace
}  // namespace verge::sim
