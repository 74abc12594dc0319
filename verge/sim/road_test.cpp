// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/sim/road.hpp"

#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "verge/core/angle.hpp"
#include "verge/core/polyline.hpp"
#include "verge/sim/caster.hpp"
#include "verge/sim/road_mesh.hpp"

namespace verge::sim {
namespace {

constexpr double kRadius_m = 30.0;
constexpr double kQuarter_m = 0.5 * std::numbers::pi * kRadius_m;

RoadConfig straight_then_left() {
  RoadConfig config;
  config.pieces = {{60.0, 0.0}, {kQuarter_m, 1.0 / kRadius_m}};
  return config;
}

TEST(Road, AQuarterTurnEndsOneRadiusOnAndOneRadiusAside) {
  const Road road(straight_then_left());
  EXPECT_NEAR(road.length_m(), 60.0 + kQuarter_m, 1e-12);
  const Station end = road.at(road.length_m());
  EXPECT_NEAR(end.position.x, 60.0 + kRadius_m, 1e-9);
  EXPECT_NEAR(end.position.y, kRadius_m, 1e-9);
  EXPECT_NEAR(rad_to_deg(end.heading_rad), 90.0, 1e-9);
}

TEST(Road, ARightTurnIsTheMirrorImageOfALeftTurn) {
  RoadConfig config = straight_then_left();
  const Road left(config);
  config.pieces[1].curvature_1pm *= -1.0;
  const Road right(config);
  for (double s = 0.0; s < left.length_m(); s += 3.7) {
    EXPECT_NEAR(left.at(s).position.x, right.at(s).position.x, 1e-9);
    EXPECT_NEAR(left.at(s).position.y, -right.at(s).position.y, 1e-9);
  }
}

TEST(Road, GoesOnStraightBeyondItsEnds) {
  const Road road(straight_then_left());
  EXPECT_NEAR(road.at(-7.0).position.x, -7.0, 1e-12);
  const Station beyond = road.at(road.length_m() + 5.0);
  EXPECT_NEAR(beyond.position.x, 90.0, 1e-9);
  EXPECT_NEAR(beyond.position.y, 35.0, 1e-9);
}

RC_GTEST_PROP(Road, TheCentreLineIsRunAtUnitSpeedAlongItsHeading, ()) {
  const double curvature = *rc::gen::inRange(-40, 41) / 1000.0;
  RoadConfig config;
  config.pieces = {{20.0, 0.0}, {30.0, curvature}, {25.0, -0.5 * curvature}};
  const Road road(config);
  const double s = *rc::gen::inRange(0, 7500) / 100.0;
  const double h = 1e-4;
  const Vec2 step = road.at(s + h).position - road.at(s).position;
  RC_ASSERT(std::fabs(norm(step) - h) < 1e-10);
  const double heading = road.at(s).heading_rad;
  RC_ASSERT(std::fabs(cross({std::cos(heading), std::sin(heading)}, step)) < 1e-8);
}

TEST(Road, IsStraightOnlyWhereNoCurveTouches) {
  const Road road(straight_then_left());
  EXPECT_TRUE(road.is_straight(0.0, 60.0));
  EXPECT_TRUE(road.is_straight(-20.0, 30.0));
  EXPECT_FALSE(road.is_straight(50.0, 60.1));
  EXPECT_FALSE(road.is_straight(70.0, 75.0));
}

TEST(Road, TheSectionFallsToTheGutterAndStepsUpByTheKerb) {
  const Road road(RoadConfig{});
  EXPECT_DOUBLE_EQ(road.height_at(0.0), 0.0);
  EXPECT_DOUBLE_EQ(road.height_at(2.0), -0.04);
  EXPECT_DOUBLE_EQ(road.height_at(-2.0), -0.04);
  EXPECT_DOUBLE_EQ(road.height_at(4.0), -0.08);
  EXPECT_NEAR(road.height_at(4.0 + 1e-9), 0.04, 1e-9);
  EXPECT_NEAR(road.height_at(5.0), 0.06, 1e-12);
  EXPECT_NEAR(road.height_at(100.0), -0.18, 1e-12);
}

TEST(Road, WithoutAKerbTheSidewalkMeetsTheRoadFlush) {
  RoadConfig config;
  config.curb_height_m = 0.0;
  const Road road(config);
  EXPECT_NEAR(road.height_at(4.0 + 1e-9), road.height_at(4.0), 1e-9);
  for (const SectionPoint& vertex : road.section()) EXPECT_NE(vertex.outward, Surface::kCurb);
}

TEST(Road, TheKerbsFootStandsHalfAWidthFromTheCentreLine) {
  const Road road(straight_then_left());
  std::vector<Vec2> center;
  for (double s = 0.0; s <= road.length_m(); s += 0.1) center.push_back(road.at(s).position);
  for (const Side side : {Side::kLeft, Side::kRight}) {
    const auto foot = road.curb_foot(side);
    EXPECT_EQ(foot.size(), static_cast<std::size_t>(std::ceil(road.length_m() / 0.1)) + 1);
    for (const Vec3& p : foot) {
      EXPECT_NEAR(distance_to(center, p.xy()), 4.0, 1e-4);
      EXPECT_DOUBLE_EQ(p.z, -0.08);
    }
    EXPECT_EQ(foot[100].y > 0.0, side == Side::kLeft);
  }
}

TEST(RoadMesh, NoChordDepartsFromItsArcByMoreThanHalfAMillimetre) {
  const Road road(straight_then_left());
  const std::vector<double> stations = mesh_stations(road);
  EXPECT_DOUBLE_EQ(stations.back(), road.length_m());
  for (std::size_t i = 0; i + 1 < stations.size(); ++i) {
    for (const double lateral : {-15.0, -4.0, 4.0, 15.0}) {
      if (std::fabs(lateral) > road.section().back().lateral_m) continue;
      const Vec2 middle =
          0.5 * (road.point(stations[i], lateral) + road.point(stations[i + 1], lateral)).xy();
      const Vec2 arc = road.point(0.5 * (stations[i] + stations[i + 1]), lateral).xy();
      EXPECT_LE(distance(middle, arc), 0.5e-3 + 1e-9) << "station " << stations[i];
    }
  }
}

TEST(RoadMesh, ARayStraightDownMeetsTheSectionsHeightAndSurface) {
  const Road road(straight_then_left());
  const Caster caster(make_world(road));
  for (double s = 0.37; s < road.length_m(); s += 1.3) {
    for (const double lateral : {-7.7, -5.1, -3.9, -0.6, 0.4, 2.2, 3.97, 4.03, 5.9, 8.3}) {
      const Vec3 ground = road.point(s, lateral);
      const auto hit = caster.cast({ground.x, ground.y, 5.0}, {0.0, 0.0, -1.0});
      ASSERT_TRUE(hit.has_value());
      EXPECT_NEAR(5.0 - hit->distance_m, ground.z, 1e-4);
      const double outward = std::fabs(lateral);
      EXPECT_EQ(hit->surface, outward < 4.0   ? Surface::kRoad
                              : outward < 6.0 ? Surface::kSidewalk
                                              : Surface::kGround);
    }
  }
}

TEST(RoadMesh, HousesStandBehindBothSidewalksAndNeverOnTheRoad) {
  RoadConfig config = straight_then_left();
  config.houses = Houses{};
  const Road road(config);
  const Caster caster(make_world(road));
  const auto house = caster.cast({5.0, 0.0, 2.0}, {0.0, 1.0, 0.0});
  ASSERT_TRUE(house.has_value());
  EXPECT_EQ(house->surface, Surface::kWall);
  EXPECT_NEAR(house->distance_m, 4.0 + 2.0 + 1.0, 1e-9);
  EXPECT_FALSE(caster.cast({12.0, 0.0, 2.0}, {0.0, 1.0, 0.0}).has_value());  // the gap
  for (double s = 0.5; s < road.length_m(); s += 1.0) {
    for (const double lateral : {-4.5, 4.5}) {
      const Vec3 p = road.point(s, lateral);
      EXPECT_NE(caster.cast({p.x, p.y, 20.0}, {0.0, 0.0, -1.0})->surface, Surface::kWall) << s;
    }
  }
}

TEST(Road, RefusesWhatIsNoRoad) {
  const auto refuses = [](auto change) {
    RoadConfig config;
    change(config);
    EXPECT_THROW(Road{config}, std::invalid_argument);
  };
  refuses([](RoadConfig& c) { c.pieces.clear(); });
  refuses([](RoadConfig& c) { c.pieces[0].length_m = 0.0; });
  refuses([](RoadConfig& c) { c.pieces[0].curvature_1pm = std::numeric_limits<double>::quiet_NaN(); });
  refuses(
      [](RoadConfig& c) { c.pieces[0].curvature_1pm = 0.2; });  // radius 5 m, half width 4 m and sidewalks
  refuses([](RoadConfig& c) { c.width_m = 0.0; });
  refuses([](RoadConfig& c) { c.cross_fall = -0.01; });
  refuses([](RoadConfig& c) { c.curb_height_m = -0.1; });
  refuses([](RoadConfig& c) { c.sidewalk_width_m = -1.0; });
  refuses([](RoadConfig& c) { c.houses = Houses{.length_m = 0.0}; });
  EXPECT_THROW((void)Road{RoadConfig{}}.curb_foot(Side::kOther), std::invalid_argument);
  EXPECT_THROW((void)Road{RoadConfig{}}.curb_foot(Side::kLeft, 0.0), std::invalid_argument);
}

}  // namespace
}  // namespace verge::sim
