// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/sim/truth.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "verge/core/angle.hpp"

namespace verge::sim {
namespace {

RoadConfig straight(double length_m = 200.0) {
  RoadConfig road;
  road.pieces = {{length_m}};
  return road;
}

RoadConfig branch(double at_m, RoadSide side, double radius_m = 5.0) {
  RoadConfig road = straight(50.0);
  road.branch_of = 1;
  road.at_m = at_m;
  road.side = side;
  road.radius_m = radius_m;
  road.width_m = 6.0;
  return road;
}

/// A world and all that tells the truth of it.
struct Stage {
  explicit Stage(const std::vector<RoadConfig>& roads)
      : land(roads, {}), furniture(land), truth(land, furniture), caster(world(), furniture.bodies()) {}

  [[nodiscard]] World world() const {
    World all = land.mesh();
    furniture.add_still(all);
    return all;
  }

  // From 1.9 m above a place, looking along the heading.
  [[nodiscard]] Scene scene(Vec2 p, double heading_rad, double radius_m = 20.0, std::size_t road = 0,
                            double time_s = 0.0) const {
    const Caster now = caster.at(furniture.poses_of_bodies(time_s));
    return truth.scene({.world = now,
                        .T_world_sensor = {from_yaw_pitch_roll(heading_rad, 0.0, 0.0), {p.x, p.y, 1.9}},
                        .heading_rad = heading_rad,
                        .road = road,
                        .time_s = time_s,
                        .radius_m = radius_m});
  }

  Land land;
  Furniture furniture;
  Truth truth;
  Caster caster;
};

std::vector<const Boundary*> on_side(const Scene& scene, Side side) {
  std::vector<const Boundary*> found;
  for (const Boundary& boundary : scene.boundaries) {
    if (boundary.side == side) found.push_back(&boundary);
  }
  return found;
}

bool all_visible(const Boundary& boundary) {
  return std::all_of(boundary.state.begin(), boundary.state.end(),
                     [](PointState state) { return state == PointState::kVisible; });
}

TEST(Truth, OnAStraightRoadTheKerbsAreLinesHalfAWidthToEachSide) {
  const Scene truth = Stage({straight()}).scene({100.0, 0.0}, 0.0);
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
  EXPECT_TRUE(all_visible(left) && all_visible(right));
}

TEST(Truth, IsClippedToTheRadiusAndRunsForward) {
  const Stage stage({straight()});
  for (const double heading : {0.0, std::numbers::pi}) {
    const Scene truth = stage.scene({100.0, 0.0}, heading);
    ASSERT_EQ(truth.boundaries.size(), 2U);
    for (const Boundary& boundary : truth.boundaries) {
      EXPECT_NEAR(boundary.points.front().x, -std::sqrt(20.0 * 20.0 - 16.0), 0.1);
      EXPECT_NEAR(boundary.points.back().x, std::sqrt(20.0 * 20.0 - 16.0), 0.1);
      EXPECT_EQ(boundary.height_m.size(), boundary.points.size());
      EXPECT_EQ(boundary.state.size(), boundary.points.size());
      EXPECT_DOUBLE_EQ(boundary.height_m.front(), 0.12);
      for (std::size_t i = 1; i < boundary.points.size(); ++i) {
        const double step = boundary.points[i].x - boundary.points[i - 1].x;
        EXPECT_GT(step, 0.0);
        EXPECT_LE(step, 0.1 + 1e-9);
      }
    }
    EXPECT_GT(on_side(truth, Side::kLeft).at(0)->points.front().y, 0.0);
  }
}

TEST(Truth, TurnsAgainstTheTurnOfTheSensor) {
  const Stage stage({straight()});
  const double yaw = deg_to_rad(10.0);
  const Scene plain = stage.scene({100.0, 0.5}, 0.0);
  const Scene turned = stage.scene({100.0, 0.5}, yaw);
  ASSERT_EQ(turned.boundaries.size(), plain.boundaries.size());
  for (std::size_t b = 0; b < turned.boundaries.size(); ++b) {
    const auto& points = turned.boundaries[b].points;
    ASSERT_EQ(points.size(), plain.boundaries[b].points.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
      const Vec3 back = rotate(from_yaw_pitch_roll(yaw, 0.0, 0.0), points[i]);
      EXPECT_NEAR(norm(back - plain.boundaries[b].points[i]), 0.0, 1e-9);
    }
  }
}

TEST(Truth, InACurveTheKerbsAreArcsAroundItsCentre) {
  const double radius = 30.0;
  RoadConfig road;
  road.pieces = {{std::numbers::pi * radius, 1.0 / radius}};
  const Stage stage({road});
  const Station middle = stage.land.roads()[0].line().at(0.5 * stage.land.roads()[0].length_m());
  const Scene truth = stage.scene(middle.position, middle.heading_rad);
  ASSERT_EQ(truth.boundaries.size(), 2U);
  for (const Boundary& boundary : truth.boundaries) {
    EXPECT_EQ(boundary.model, Model::kPolyline);
    const double expected = boundary.side == Side::kLeft ? radius - 4.0 : radius + 4.0;
    for (const Vec3& p : boundary.points)
      EXPECT_NEAR(distance(p.xy(), {0.0, radius}), expected, kChordErrorMax_m);
  }
}

TEST(Truth, ABoundaryThatLeavesTheCircleAndComesBackIsTwo) {
  const double radius = 15.0;  // a hairpin: out, half a turn, and back beside itself
  RoadConfig road;
  road.width_m = 4.0;
  road.sidewalk_m = 0.0;
  road.pieces = {{60.0}, {std::numbers::pi * radius, 1.0 / radius}, {60.0}};
  EXPECT_EQ(Stage({road}).scene({20.0, 15.0}, 0.0).boundaries.size(), 4U);
}

TEST(Truth, FarFromTheRoadThereIsNone) {
  EXPECT_TRUE(Stage({straight()}).scene({100.0, 120.0}, 0.0).boundaries.empty());
}

TEST(Truth, TheKindsOfEdgesAreTold) {
  const auto kind_of = [](Edge edge, double kerb_m) {
    RoadConfig road = straight();
    road.left = edge;
    road.kerb_m = kerb_m;
    return Stage({road}).scene({100.0, 0.0}, 0.0).boundaries.at(0).kind;
  };
  EXPECT_EQ(kind_of(Edge::kKerb, 0.12), BoundaryKind::kCurb);
  EXPECT_EQ(kind_of(Edge::kKerb, 0.02), BoundaryKind::kFlush);
  EXPECT_EQ(kind_of(Edge::kFlush, 0.12), BoundaryKind::kFlush);
  EXPECT_EQ(kind_of(Edge::kGrass, 0.12), BoundaryKind::kVerge);
  EXPECT_EQ(kind_of(Edge::kDitch, 0.12), BoundaryKind::kVerge);
  EXPECT_EQ(kind_of(Edge::kWall, 0.12), BoundaryKind::kWall);
}

TEST(Truth, WhatABoxHidesIsOccludedAndNothingElse) {
  RoadConfig road = straight();
  road.items = {{.what = Thing::kHouse,
                 .at_m = 100.0,
                 .lateral_m = 2.5,
                 .length_m = 2.0,
                 .width_m = 1.0,
                 .height_m = 6.0}};
  const Scene truth = Stage({road}).scene({100.0, 0.0}, 0.0);
  const Boundary& left = *on_side(truth, Side::kLeft).at(0);
  for (std::size_t i = 0; i < left.points.size(); ++i) {
    const Vec3 p = left.points[i];
    // The near face of the box is 2 m to the left, from -1 to 1: as seen from the sensor it hides up to |x| =
    // 2; its far corners, 3 m to the left, hide less.
    const double shadow = 1.0 / 2.0 * 4.0;
    if (std::fabs(std::fabs(p.x) - shadow) < 0.05) continue;
    EXPECT_EQ(left.state[i], std::fabs(p.x) < shadow ? PointState::kOccluded : PointState::kVisible) << p.x;
  }
  EXPECT_TRUE(all_visible(*on_side(truth, Side::kRight).at(0)));
}

TEST(Truth, AtACornerTheBoundaryGoesOnRoundItIntoTheSideRoad) {
  const Stage stage({straight(), branch(110.0, RoadSide::kLeft)});
  const Scene truth = stage.scene({100.0, -2.0}, 0.0, 30.0);
  const auto left = on_side(truth, Side::kLeft);
  ASSERT_EQ(left.size(), 2U);
  for (const Boundary* boundary : left) {
    double farthest = 0.0;
    for (const Vec3& p : boundary->points) farthest = std::max(farthest, p.y);
    EXPECT_GT(farthest, 15.0);
  }
  EXPECT_EQ(on_side(truth, Side::kRight).size(), 1U);
}

TEST(Truth, ACornerIsWhereItsKerbReturnBegins) {
  const Stage stage({straight(), branch(110.0, RoadSide::kLeft)});
  const Scene truth = stage.scene({90.0, -2.0}, 0.0, 30.0);
  ASSERT_EQ(truth.corners.size(), 1U);
  const Corner& corner = truth.corners[0];
  EXPECT_EQ(corner.side, CornerSide::kLeft);
  EXPECT_NEAR(corner.position.x, 110.0 - 3.0 - 5.0 - 90.0, 1e-6);
  EXPECT_NEAR(corner.position.y, 6.0, 1e-6);
  EXPECT_NEAR(*corner.distance_m, 12.0, 1e-6);
  EXPECT_NEAR(*corner.exit_m, 28.0, 1e-6);
  EXPECT_NEAR(*corner.width_m, 6.0, 1e-9);
  ASSERT_EQ(truth.openings.size(), 1U);
  EXPECT_NEAR(truth.openings[0].width_m, 16.0, 1e-6);
  EXPECT_NEAR(truth.openings[0].ends[0].x, 12.0, 1e-6);
  ASSERT_EQ(truth.junctions.size(), 1U);
  EXPECT_EQ(truth.junctions[0].type, JunctionType::kLeft);
  EXPECT_NEAR(truth.junctions[0].center.x, 20.0, 1e-9);
  EXPECT_NEAR(truth.junctions[0].center.y, 2.0, 1e-9);
  EXPECT_EQ(truth.junctions[0].branches_rad.size(), 3U);
}

TEST(Truth, GoingTheOtherWayTheCornerLiesOnTheOtherSideAndBeginsAtItsOtherEnd) {
  const Stage stage({straight(), branch(110.0, RoadSide::kLeft)});
  const Scene truth = stage.scene({130.0, 2.0}, std::numbers::pi, 30.0);
  ASSERT_EQ(truth.corners.size(), 1U);
  EXPECT_EQ(truth.corners[0].side, CornerSide::kRight);
  EXPECT_NEAR(*truth.corners[0].distance_m, 12.0, 1e-6);
  EXPECT_EQ(truth.junctions.at(0).type, JunctionType::kRight);
}

TEST(Truth, ACornerThatIsPassedIsNoneAnyMore) {
  const Stage stage({straight(), branch(110.0, RoadSide::kLeft)});
  EXPECT_EQ(stage.scene({117.9, -2.0}, 0.0).corners.size(), 1U);
  EXPECT_TRUE(stage.scene({118.1, -2.0}, 0.0).corners.empty());
  EXPECT_TRUE(stage.scene({118.1, -2.0}, 0.0).junctions.empty());
}

TEST(Truth, BranchesToBothSidesAreOneCrossing) {
  const Stage stage({straight(), branch(110.0, RoadSide::kLeft), branch(110.0, RoadSide::kRight)});
  const Scene truth = stage.scene({95.0, -2.0}, 0.0);
  ASSERT_EQ(truth.junctions.size(), 1U);
  EXPECT_EQ(truth.junctions[0].type, JunctionType::kCrossing);
  EXPECT_EQ(truth.junctions[0].branches_rad.size(), 4U);
  EXPECT_EQ(truth.corners.size(), 2U);
}

TEST(Truth, FromTheSideRoadItIsATWithAwayToBothSides) {
  const Stage stage({straight(), branch(110.0, RoadSide::kLeft)});
  const Scene truth = stage.scene({110.0, 24.0}, -0.5 * std::numbers::pi, 30.0, 1);
  ASSERT_EQ(truth.junctions.size(), 1U);
  EXPECT_EQ(truth.junctions[0].type, JunctionType::kT);
  EXPECT_NEAR(truth.junctions[0].center.x, 24.0, 1e-9);
  EXPECT_EQ(truth.corners.at(0).side, CornerSide::kBoth);
  EXPECT_NEAR(*truth.corners[0].distance_m, 24.0 - 9.0, 1e-6);
  EXPECT_EQ(on_side(truth, Side::kLeft).size(), 1U);
  EXPECT_EQ(on_side(truth, Side::kRight).size(), 1U);
  EXPECT_EQ(on_side(truth, Side::kOther).size(), 1U);  // the far kerb of the road across
}

TEST(Truth, DrivewaysAndGapsAreOpeningsButFalseCorners) {
  RoadConfig drive = branch(95.0, RoadSide::kRight, 0.3);
  drive.driveway = true;
  drive.width_m = 2.0;
  RoadConfig road = straight();
  road.gaps = {{RoadSide::kLeft, 105.0, 1.5, 0.0, 0.3}, {RoadSide::kLeft, 112.0, 1.5, 0.06, 0.3}};
  const Scene truth = Stage({road, drive}).scene({90.0, 0.0}, 0.0, 30.0);
  ASSERT_EQ(truth.corners.size(), 2U);
  for (const Corner& corner : truth.corners) EXPECT_EQ(corner.confidence, 0.0);
  EXPECT_EQ(truth.corners[0].side, CornerSide::kRight);
  EXPECT_EQ(truth.corners[1].side, CornerSide::kLeft);
  EXPECT_NEAR(*truth.corners[1].distance_m, 105.0 - 0.75 - 90.0, 1e-6);
  EXPECT_NEAR(*truth.corners[1].width_m, 1.5, 1e-9);
  EXPECT_TRUE(truth.junctions.empty());
  ASSERT_EQ(truth.openings.size(), 2U);  // a kerb lowered to 6 cm is no opening
  EXPECT_NEAR(truth.openings[0].width_m, 2.6, 1e-6);
  EXPECT_NEAR(truth.openings[1].width_m, 1.5, 1e-9);
  const auto left = on_side(truth, Side::kLeft);
  ASSERT_EQ(left.size(), 3U);
  EXPECT_EQ(std::count_if(left.begin(), left.end(),
                          [](const Boundary* b) { return b->kind == BoundaryKind::kFlush; }),
            1);
}

TEST(Truth, WideGapsBetweenParkedCarsAreFalseCorners) {
  RoadConfig road = straight();
  const auto car = [](double at_m, double lateral_m, double speed_mps) {
    return Item{
        .what = Thing::kCar, .at_m = at_m, .lateral_m = lateral_m, .speed_mps = speed_mps, .length_m = 4.0};
  };
  road.items = {car(100.0, 3.5, 0.0), car(104.9, 3.5, 0.0), car(110.9, 3.5, 0.0),
                car(116.0, 0.0, 0.0), car(117.0, 3.5, 5.0), car(130.0, 3.5, 0.0)};
  const Scene truth = Stage({road}).scene({90.0, 0.0}, 0.0, 30.0);
  ASSERT_EQ(truth.corners.size(), 1U);  // gaps of 0.9, 2 and 15 m; one car is on the road, one drives
  EXPECT_EQ(truth.corners[0].confidence, 0.0);
  EXPECT_EQ(truth.corners[0].side, CornerSide::kLeft);
  EXPECT_NEAR(*truth.corners[0].distance_m, 16.9, 1e-6);
  EXPECT_NEAR(*truth.corners[0].exit_m, 18.9, 1e-6);
  EXPECT_NEAR(truth.corners[0].position.y, 2.6, 0.2) << "on the line of the cars' sides, not of the kerb";
}

TEST(Truth, AnIslandIsABoundaryOfItsOwn) {
  RoadConfig road = straight();
  road.islands = {{105.0, 0.0, 6.0, 1.5}};
  const Scene truth = Stage({road}).scene({100.0, -2.0}, 0.0);
  EXPECT_EQ(on_side(truth, Side::kIsland).size(), 1U);
}

TEST(Truth, ObjectsHaveTheirBoxesInTheSensorFrameAtTheirTime) {
  RoadConfig road = straight();
  road.items = {{.what = Thing::kCar, .at_m = 110.0, .lateral_m = 2.0, .yaw_deg = 180.0, .speed_mps = -5.0},
                {.what = Thing::kPole, .at_m = 95.0, .lateral_m = -5.0},
                {.what = Thing::kCar, .at_m = 180.0, .lateral_m = 2.0}};
  const Stage stage({road});
  const Scene truth = stage.scene({100.0, 0.0}, 0.5 * std::numbers::pi, 20.0, 0, 1.0);
  ASSERT_EQ(truth.objects.size(), 2U);
  const Object& car = truth.objects[0];
  EXPECT_EQ(car.type, ObjectClass::kCar);
  EXPECT_EQ(car.id, 1);
  EXPECT_NEAR(car.center.x, 2.0, 1e-9);  // the sensor looks to the road's left
  EXPECT_NEAR(car.center.y, -5.0, 1e-9);
  EXPECT_NEAR(car.center.z, -1.9 - 0.04 + 0.75, 1e-9);
  EXPECT_NEAR(car.size.length_m, 4.4, 1e-12);
  EXPECT_NEAR(wrap_pi(car.yaw_rad - 0.5 * std::numbers::pi), 0.0, 1e-9);
  EXPECT_EQ(truth.objects[1].type, ObjectClass::kPole);
}

TEST(Truth, TheWidthOfTheRoadAheadIsTold) {
  RoadConfig road = straight();
  road.widths = {{100.0, 8.0}, {120.0, 12.0}};
  const Scene truth = Stage({road}).scene({100.0, 0.0}, 0.0);
  ASSERT_TRUE(truth.road.has_value());
  ASSERT_EQ(truth.road->width_m.size(), 5U);
  EXPECT_NEAR(truth.road->width_m[2].width_m, 10.0, 1e-9);
}

}  // namespace
}  // namespace verge::sim
