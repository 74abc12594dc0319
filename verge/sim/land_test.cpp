// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/sim/land.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>

#include "verge/core/angle.hpp"
#include "verge/sim/caster.hpp"

namespace verge::sim {
namespace {

RoadConfig straight(double length_m = 100.0) {
  RoadConfig road;
  road.pieces = {{length_m}};
  return road;
}

RoadConfig straight_then_left() {
  RoadConfig road;
  road.pieces = {{60.0}, {0.5 * std::numbers::pi * 30.0, 1.0 / 30.0}};
  return road;
}

double height_by_ray(const Caster& caster, Vec2 p) {
  const auto hit = caster.cast({p.x, p.y, 60.0}, {0.0, 0.0, -1.0});
  return hit ? 60.0 - hit->distance_m : std::nan("");
}

TEST(Ground, TheCarriagewayFallsFromItsCrownToBothSides) {
  const auto roads = make_roads({straight()});
  const Ground ground({.crown = 0.02}, roads);
  EXPECT_NEAR(ground.road({50.0, 0.0}), 0.0, 1e-12);
  EXPECT_NEAR(ground.road({50.0, 2.0}), -0.04, 1e-12);
  EXPECT_NEAR(ground.road({50.0, -4.0}), -0.08, 1e-12);
}

TEST(Ground, CrossFallRisesToTheLeft) {
  const auto roads = make_roads({straight()});
  const Ground ground({.crown = 0.0, .cross_fall = 0.05}, roads);
  EXPECT_NEAR(ground.road({50.0, 3.0}), 0.15, 1e-12);
  EXPECT_NEAR(ground.road({50.0, -3.0}), -0.15, 1e-12);
  EXPECT_NEAR(ground.land({50.0, 100.0}), 1.5, 1e-12);  // it stops leaning 30 m away
}

TEST(Ground, AClimbIsEvenBetweenItsVerticalCurvesAndAParabolaInThem) {
  RoadConfig config = straight(200.0);
  config.heights = {{50.0, 0.0}, {150.0, 8.0}};
  config.vertical_curve_m = 20.0;
  const auto roads = make_roads({config});
  EXPECT_NEAR(roads[0].profile(30.0), 0.0, 1e-12);
  EXPECT_NEAR(roads[0].profile(100.0), 4.0, 1e-9);
  EXPECT_NEAR(roads[0].profile(101.0) - roads[0].profile(100.0), 0.08, 1e-9);
  // The parabola from slope 0 to 0.08 over 20 m: 0.08 / 20 * x^2 / 2.
  for (const double x : {0.0, 5.0, 10.0, 20.0}) {
    EXPECT_NEAR(roads[0].profile(40.0 + x), 0.5 * 0.08 / 20.0 * x * x, 1e-9);
  }
  EXPECT_NEAR(roads[0].profile(190.0), 8.0, 1e-9);
}

TEST(Ground, BumpsHaveTheAskedDeviationAndMeanAndDependOnTheSeedAlone) {
  double sum = 0.0;
  double squares = 0.0;
  int count = 0;
  for (double x = -150.0; x < 150.0; x += 1.37) {
    for (double y = -150.0; y < 150.0; y += 1.41) {
      const double b = bumps({x, y}, 2.0, 3);
      sum += b;
      squares += b * b;
      ++count;
    }
  }
  EXPECT_NEAR(sum / count, 0.0, 0.03);
  EXPECT_NEAR(std::sqrt(squares / count), 1.0, 0.03);
  EXPECT_EQ(bumps({1.2, 3.4}, 2.0, 3), bumps({1.2, 3.4}, 2.0, 3));
  EXPECT_NE(bumps({1.2, 3.4}, 2.0, 3), bumps({1.2, 3.4}, 2.0, 4));
}

TEST(Land, TheSectionFallsToTheGutterAndStepsUpByTheKerb) {
  const Land land({straight()}, {});
  const auto height = [&](double y) { return land.height({50.0, y}); };
  EXPECT_NEAR(height(0.0), 0.0, 1e-12);
  EXPECT_NEAR(height(-2.0), -0.04, 1e-12);
  EXPECT_NEAR(height(4.0), -0.08, 1e-9);
  EXPECT_NEAR(height(4.0 + 1e-6), 0.04, 1e-6);
  EXPECT_NEAR(height(5.0), 0.06, 1e-9);
  EXPECT_NEAR(height(7.0), 0.03, 1e-9);  // 5 % down from the sidewalk's outer side
  EXPECT_NEAR(height(60.0), -0.18, 1e-9);
}

TEST(Land, WithoutAKerbTheSidewalkMeetsTheRoadFlush) {
  RoadConfig road = straight();
  road.left = road.right = Edge::kFlush;
  const Land land({road}, {});
  EXPECT_NEAR(land.height({50.0, 4.0 + 1e-9}), land.height({50.0, 4.0}), 1e-6);
  const World world = land.mesh();
  EXPECT_EQ(std::count(world.surface.begin(), world.surface.end(), Surface::kCurb), 0);
}

TEST(Land, GrassFallsAwayAndADitchLiesBehindItsShoulder) {
  RoadConfig road = straight();
  road.left = Edge::kGrass;
  road.right = Edge::kDitch;
  const Land land({road}, {});
  EXPECT_NEAR(land.height({50.0, 5.0}), -0.12, 1e-9);
  EXPECT_NEAR(land.height({50.0, -5.0}), -0.12, 1e-9);
  EXPECT_NEAR(land.height({50.0, -6.1}), -0.72, 1e-9);
  EXPECT_EQ(land.surface({50.0, 4.5}), Surface::kGround);
}

TEST(LandMesh, ARayStraightDownMeetsTheHeightAndTheSurface) {
  const Land land({straight_then_left()}, {});
  const Caster caster(land.mesh());
  const CenterLine& line = land.roads()[0].line();
  for (double s = 4.37; s < line.length_m() - 4.0; s += 1.3) {  // at its open ends the section ends too
    for (const double lateral : {-7.7, -5.1, -3.9, -0.6, 0.4, 2.2, 3.97, 4.03, 5.9, 8.3}) {
      const Vec2 p = line.point(s, lateral);
      const auto hit = caster.cast({p.x, p.y, 5.0}, {0.0, 0.0, -1.0});
      ASSERT_TRUE(hit.has_value());
      EXPECT_NEAR(5.0 - hit->distance_m, land.height(p), 2e-3) << s << " " << lateral;
      const double outward = std::fabs(lateral);
      if (outward > 5.8 && outward < 6.2) continue;
      EXPECT_EQ(hit->surface, outward < 4.0   ? Surface::kRoad
                              : outward < 6.0 ? Surface::kSidewalk
                                              : Surface::kGround)
          << s << " " << lateral;
    }
  }
}

TEST(LandMesh, OnAStraightRoadItIsExact) {
  const Land land({straight()}, {});
  const Caster caster(land.mesh());
  for (double x = 3.3; x < 97.0; x += 4.7) {
    for (const double y : {-7.7, -5.1, -3.9, -0.6, 0.4, 2.2, 3.97, 4.03, 5.9, 8.3}) {
      EXPECT_NEAR(height_by_ray(caster, {x, y}), land.height({x, y}), 1e-6) << x << " " << y;
    }
  }
}

TEST(LandMesh, AKerbsFaceIsHitWhereItsSectionSays) {
  for (const KerbFace face : {KerbFace::kVertical, KerbFace::kSloped, KerbFace::kWorn}) {
    RoadConfig road = straight();
    road.face = face;
    road.kerb_m = 0.15;
    const Land land({road}, {.crown = 0.0});
    const Caster caster(land.mesh());
    const auto at = [&](double z) { return caster.cast({50.0, 0.0, z}, {0.0, 1.0, 0.0}); };
    const double half = face == KerbFace::kVertical ? 0.0
                        : face == KerbFace::kSloped ? 0.3 * 0.15
                                                    : 0.05 * 0.15;
    ASSERT_TRUE(at(0.075).has_value());
    EXPECT_NEAR(at(0.075)->distance_m, 4.0 + half, 1e-9);
    EXPECT_EQ(at(0.075)->surface, Surface::kCurb);
  }
}

TEST(LandMesh, AKerbReturnIsHitOnItsArc) {
  RoadConfig side = straight(40.0);
  side.branch_of = 1;
  side.at_m = 50.0;
  side.side = RoadSide::kLeft;
  side.width_m = 6.0;
  for (const double radius : {0.5, 3.0, 8.0}) {
    side.radius_m = radius;
    const Land land({straight(), side}, {.crown = 0.0});
    const Caster caster(land.mesh());
    const Vec2 center = {50.0 - 3.0 - radius, 4.0 + radius};
    for (double deg = -80.0; deg <= -10.0; deg += 7.0) {
      const Vec2 toward = -1.0 * along(deg_to_rad(deg));  // to the centre of the arc
      const Vec2 from = center - (radius + 2.0) * toward;
      const auto hit = caster.cast({from.x, from.y, 0.06}, {toward.x, toward.y, 0.0});
      ASSERT_TRUE(hit.has_value());
      EXPECT_NEAR(hit->distance_m, 2.0, 0.6e-3) << radius << " " << deg;
      EXPECT_EQ(hit->surface, Surface::kCurb);
    }
  }
}

TEST(LandMesh, HasNoHolesAndNothingBelowItself) {
  RoadConfig side = straight(40.0);
  side.branch_of = 1;
  side.at_m = 50.0;
  side.radius_m = 5.0;
  RoadConfig main = straight();
  main.face = KerbFace::kWorn;
  main.islands = {{20.0, 0.0, 6.0, 1.5}};
  main.bays = {{RoadSide::kLeft, 40.0, 20.0, 2.0, 1.5}};
  main.gaps = {{RoadSide::kRight, 75.0, 2.0, 0.0, 0.3}};
  const Land land({main, side}, {.crown = 0.02, .roughness_m = 0.01});
  const Caster caster(land.mesh());
  for (double x = -20.13; x < 120.0; x += 1.31) {
    for (double y = -60.17; y < 30.0; y += 1.17) {
      const double height = height_by_ray(caster, {x, y});
      ASSERT_FALSE(std::isnan(height)) << x << " " << y;
      EXPECT_NEAR(height, land.height({x, y}), 0.17) << x << " " << y;  // a kerb's step, and bumps
    }
  }
}

TEST(LandMesh, FollowsACrestAlongTheRoad) {
  RoadConfig road = straight(200.0);
  road.heights = {{50.0, 0.0}, {100.0, 4.0}, {150.0, 0.0}};
  const Land land({road}, {});
  const Caster caster(land.mesh());
  for (double x = 5.0; x < 195.0; x += 3.3) {
    for (const double y : {-3.0, 0.0, 2.5, 5.0}) {
      EXPECT_NEAR(height_by_ray(caster, {x, y}), land.height({x, y}), 3e-3) << x << " " << y;
    }
  }
}

TEST(Land, RefusesRoadsThatCrossEachOtherOrThemselves) {
  RoadConfig other = straight();
  other.x_m = 50.0;
  other.y_m = -30.0;
  other.heading_deg = 90.0;
  EXPECT_THROW((void)Land({straight(), other}, {}).mesh(), std::invalid_argument);
}

}  // namespace
}  // namespace verge::sim
