// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/sim/truth.hpp"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "verge/core/angle.hpp"

namespace verge::sim {
namespace {

Pose at(Vec3 position, double yaw_rad) { return {from_yaw_pitch_roll(yaw_rad, 0.0, 0.0), position}; }

TEST(Truth, OnAStraightRoadTheKerbsAreLinesHalfAWidthToEachSide) {
  const Road road(RoadConfig{});
  const Scene truth = truth_scene(curb_feet(road), at({100.0, 0.0, 1.9}, 0.0), 20.0);
  ASSERT_EQ(truth.boundaries.size(), 2U);
  const Boundary& left = truth.boundaries[0];
  const Boundary& right = truth.boundaries[1];
  EXPECT_EQ(left.side, Side::kLeft);
  EXPECT_EQ(right.side, Side::kRight);
  EXPECT_EQ(left.model, Model::kLine);
  EXPECT_EQ(left.kind, BoundaryKind::kCurb);
  EXPECT_NE(left.id, right.id);
  for (const Vec3& p : left.points) EXPECT_NEAR(p.y, 4.0, 1e-9);
  for (const Vec3& p : right.points) EXPECT_NEAR(p.y, -4.0, 1e-9);
  for (const Vec3& p : left.points) EXPECT_NEAR(p.z, -0.08 - 1.9, 1e-9);
}

TEST(Truth, IsClippedToTheRadiusAndRunsForward) {
  const Road road(RoadConfig{});
  const Scene truth = truth_scene(curb_feet(road), at({100.0, 0.0, 1.9}, 0.0), 20.0);
  for (const Boundary& boundary : truth.boundaries) {
    EXPECT_NEAR(boundary.points.front().x, -std::sqrt(20.0 * 20.0 - 16.0), 0.1);
    EXPECT_NEAR(boundary.points.back().x, std::sqrt(20.0 * 20.0 - 16.0), 0.1);
    EXPECT_EQ(boundary.height_m.size(), boundary.points.size());
    EXPECT_DOUBLE_EQ(boundary.height_m.front(), 0.12);
    for (std::size_t i = 1; i < boundary.points.size(); ++i) {
      EXPECT_NEAR(boundary.points[i].x - boundary.points[i - 1].x, 0.1, 1e-9);
    }
  }
}

TEST(Truth, TurnsAgainstTheTurnOfTheSensor) {
  const Road road(RoadConfig{});
  const double yaw = deg_to_rad(10.0);
  const Scene straight = truth_scene(curb_feet(road), at({100.0, 0.5, 1.9}, 0.0), 20.0);
  const Scene turned = truth_scene(curb_feet(road), at({100.0, 0.5, 1.9}, yaw), 20.0);
  ASSERT_EQ(turned.boundaries.size(), straight.boundaries.size());
  for (std::size_t b = 0; b < turned.boundaries.size(); ++b) {
    const auto& points = turned.boundaries[b].points;
    ASSERT_EQ(points.size(), straight.boundaries[b].points.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
      const Vec3 back = rotate(from_yaw_pitch_roll(yaw, 0.0, 0.0), points[i]);
      EXPECT_NEAR(norm(back - straight.boundaries[b].points[i]), 0.0, 1e-9);
    }
  }
}

TEST(Truth, InACurveTheKerbsAreArcsAroundItsCentre) {
  const double radius = 30.0;
  RoadConfig config;
  config.pieces = {{std::numbers::pi * radius, 1.0 / radius}};
  const Road road(config);
  const Station middle = road.at(0.5 * road.length_m());
  const Pose T_world_sensor = at({middle.position.x, middle.position.y, 1.9}, middle.heading_rad);
  const Scene truth = truth_scene(curb_feet(road), T_world_sensor, 20.0);
  ASSERT_EQ(truth.boundaries.size(), 2U);
  for (const Boundary& boundary : truth.boundaries) {
    EXPECT_EQ(boundary.model, Model::kPolyline);
    const double expected = boundary.side == Side::kLeft ? radius - 4.0 : radius + 4.0;
    for (const Vec3& p : boundary.points) EXPECT_NEAR(distance(p.xy(), {0.0, radius}), expected, 1e-9);
  }
}

TEST(Truth, ABoundaryThatLeavesTheCircleAndComesBackIsTwo) {
  const double radius = 15.0;  // a hairpin: out, half a turn, and back beside itself
  RoadConfig config;
  config.width_m = 4.0;
  config.sidewalk_width_m = 0.0;
  config.pieces = {{60.0, 0.0}, {std::numbers::pi * radius, 1.0 / radius}, {60.0, 0.0}};
  const Scene truth = truth_scene(curb_feet(Road(config)), at({20.0, 15.0, 1.9}, 0.0), 20.0);
  EXPECT_EQ(truth.boundaries.size(), 4U);
}

TEST(Truth, FarFromTheRoadThereIsNone) {
  EXPECT_TRUE(
      truth_scene(curb_feet(Road(RoadConfig{})), at({100.0, 300.0, 1.9}, 0.0), 30.0).boundaries.empty());
}

TEST(Truth, AKerbOfNoHeightIsFlush) {
  RoadConfig config;
  config.curb_height_m = 0.0;
  const Scene truth = truth_scene(curb_feet(Road(config)), at({100.0, 0.0, 1.9}, 0.0), 30.0);
  EXPECT_EQ(truth.boundaries.at(0).kind, BoundaryKind::kFlush);
}

}  // namespace
}  // namespace verge::sim
