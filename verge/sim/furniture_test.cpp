// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/sim/furniture.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>

#include "verge/sim/caster.hpp"

namespace verge::sim {
namespace {

RoadConfig straight() {
  RoadConfig road;
  road.pieces = {{100.0}};
  return road;
}

constexpr GroundConfig kLevel = {.crown = 0.0};

Caster caster_of(const Land& land, const Furniture& furniture) {
  World world = land.mesh();
  furniture.add_still(world);
  return Caster(std::move(world), furniture.bodies());
}

TEST(Things, EveryThingTouchesTheSidesOfItsBoxAndStandsOnItsFoot) {
  for (std::size_t i = 0; i < enum_names<Thing>.size(); ++i) {
    const auto thing = static_cast<Thing>(i);
    if (is_continuous(thing)) continue;
    const Vec3 size = usual_size(thing);
    const World shape = shape_of(thing, size, 7);
    Vec3 low = shape.vertices.front();
    Vec3 high = low;
    for (const Vec3& p : shape.vertices) {
      low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
      high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
    }
    EXPECT_NEAR(low.z, 0.0, 1e-9) << enum_names<Thing>.at(i);
    EXPECT_NEAR(high.z, size.z, 1e-9) << enum_names<Thing>.at(i);
    EXPECT_NEAR(high.x, 0.5 * size.x, 1e-9) << enum_names<Thing>.at(i);
    EXPECT_NEAR(low.x, -0.5 * size.x, 1e-9) << enum_names<Thing>.at(i);
    EXPECT_NEAR(high.y, 0.5 * size.y, 1e-9) << enum_names<Thing>.at(i);
    EXPECT_TRUE(
        std::all_of(shape.object.begin(), shape.object.end(), [](std::uint32_t id) { return id == 7; }));
  }
}

TEST(Furniture, ACarsRearAndFlankAreHitWhereItsBoxSays) {
  RoadConfig road = straight();
  road.items = {{.what = Thing::kCar, .at_m = 50.0, .lateral_m = 2.0}};
  const Land land({road}, kLevel);
  const Furniture furniture(land);
  const Caster caster = caster_of(land, furniture);
  const auto rear = caster.cast({30.0, 2.0, 0.5}, {1.0, 0.0, 0.0});
  ASSERT_TRUE(rear.has_value());
  EXPECT_NEAR(rear->distance_m, 20.0 - 2.2, 1e-9);
  EXPECT_EQ(rear->surface, Surface::kVehicle);
  EXPECT_EQ(rear->object, 1U);
  EXPECT_NEAR(caster.cast({50.0, -3.0, 0.5}, {0.0, 1.0, 0.0})->distance_m, 5.0 - 0.9, 1e-9);
}

TEST(Furniture, ARowStandsBesideTheEdgeWithItsGaps) {
  RoadConfig road = straight();
  road.rows = {{.what = Thing::kCar,
                .side = RoadSide::kRight,
                .from_m = 20.0,
                .to_m = 50.0,
                .beside_m = -0.3,
                .gap_m = 2.0}};
  const Land land({road}, kLevel);
  const Furniture furniture(land);
  ASSERT_EQ(furniture.things().size(), 5U);  // 5 * 4.4 + 4 * 2 = 30
  for (std::size_t i = 0; i < 5; ++i) {
    const Pose pose = furniture.pose(furniture.things()[i], 0.0);
    EXPECT_NEAR(pose.translation.x, 22.2 + 6.4 * static_cast<double>(i), 1e-9);
    EXPECT_NEAR(pose.translation.y, -(4.0 - 0.3 - 0.9), 1e-9);
  }
}

TEST(Furniture, ARowLeavesMouthsFree) {
  RoadConfig road = straight();
  road.rows = {{.what = Thing::kHedge, .side = RoadSide::kLeft, .beside_m = 0.5},
               {.what = Thing::kPole, .side = RoadSide::kLeft, .beside_m = 0.5, .gap_m = 1.0}};
  RoadConfig side = straight();
  side.branch_of = 1;
  side.at_m = 50.0;
  side.side = RoadSide::kLeft;
  const Land land({road, side}, kLevel);
  const Furniture furniture(land);
  const Mouth& mouth = land.outline().mouths[0];
  for (const Placed& pole : furniture.things()) {
    EXPECT_TRUE(pole.item.at_m < mouth.begin_m || pole.item.at_m > mouth.end_m);
  }
  const Caster caster = caster_of(land, furniture);
  EXPECT_EQ(caster.cast({30.6, 0.0, 1.0}, {0.0, 1.0, 0.0})->surface, Surface::kVegetation);
  EXPECT_NEAR(caster.cast({30.6, 0.0, 1.0}, {0.0, 1.0, 0.0})->distance_m, 4.5, 1e-9);
  EXPECT_FALSE(caster.cast({50.0, 0.0, 1.0}, {0.0, 1.0, 0.0}).has_value());
}

TEST(Furniture, AGuardRailHangsOverTheGround) {
  RoadConfig road = straight();
  road.rows = {{.what = Thing::kGuardRail, .side = RoadSide::kRight, .beside_m = 0.5}};
  const Land land({road}, kLevel);
  const Caster caster = caster_of(land, Furniture(land));
  EXPECT_NEAR(caster.cast({50.1, 0.0, 0.7}, {0.0, -1.0, 0.0})->distance_m, 4.5, 1e-9);
  EXPECT_FALSE(caster.cast({50.1, 0.0, 0.3}, {0.0, -1.0, 0.0}).has_value());
}

TEST(Furniture, WhatMovesIsWhereItsSpeedBringsIt) {
  RoadConfig road = straight();
  road.items = {{.what = Thing::kCar, .at_m = 50.0, .lateral_m = 2.0, .yaw_deg = 180.0, .speed_mps = -10.0},
                {.what = Thing::kPerson, .at_m = 20.0, .lateral_m = -3.0, .across_mps = 1.5},
                {.what = Thing::kBin, .at_m = 80.0, .lateral_m = 5.0}};
  const Land land({road}, kLevel);
  const Furniture furniture(land);
  const Caster still = caster_of(land, furniture);
  ASSERT_EQ(furniture.bodies().size(), 2U);
  for (const double time_s : {0.0, 0.7, 2.0}) {
    const Caster caster = still.at(furniture.poses_of_bodies(time_s));
    const auto car = caster.cast({0.0, 2.0, 0.5}, {1.0, 0.0, 0.0});
    EXPECT_NEAR(car->distance_m, 50.0 - 10.0 * time_s - 2.2, 1e-9);
    EXPECT_EQ(car->object, 1U);
    const auto person = caster.cast({20.0, 30.0, 1.0}, {0.0, -1.0, 0.0});
    EXPECT_NEAR(person->distance_m, 30.0 - (-3.0 + 1.5 * time_s), 0.26);
    EXPECT_EQ(person->surface, Surface::kPerson);
    EXPECT_EQ(caster.cast({80.0, 30.0, 0.6}, {0.0, -1.0, 0.0})->object, 3U);
  }
}

TEST(Furniture, RefusesAWallThatIsNoRow) {
  RoadConfig road = straight();
  road.items = {{.what = Thing::kWall}};
  const Land land({road}, kLevel);
  EXPECT_THROW(Furniture{land}, std::invalid_argument);
}

}  // namespace
}  // namespace verge::sim
