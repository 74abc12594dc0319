// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/sim/outline.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "verge/core/angle.hpp"
#include "verge/core/polyline.hpp"
#include "verge/sim/outline_index.hpp"

namespace verge::sim {
namespace {

RoadConfig straight(double length_m, double width_m) {
  RoadConfig road;
  road.pieces = {{length_m}};
  road.width_m = width_m;
  return road;
}

RoadConfig branch(double at_m, RoadSide side, double width_m, double radius_m, double angle_deg = 90.0) {
  RoadConfig road = straight(40.0, width_m);
  road.branch_of = 1;
  road.at_m = at_m;
  road.side = side;
  road.radius_m = radius_m;
  road.angle_deg = angle_deg;
  return road;
}

Outline outline_of(const std::vector<RoadConfig>& configs) { return make_outline(make_roads(configs), 2.0); }

double area_of(const OutlineLoop& loop) {
  double twice = 0.0;
  for (std::size_t i = 0; i < loop.vertices.size(); ++i) {
    twice += cross(loop.vertices[i].position, loop.vertices[(i + 1) % loop.vertices.size()].position);
  }
  return 0.5 * twice;
}

TEST(Outline, OfAStraightRoadIsARectangle) {
  const Outline outline = outline_of({straight(100.0, 8.0)});
  ASSERT_EQ(outline.loops.size(), 1U);
  EXPECT_NEAR(area_of(outline.loops[0]), 800.0, 1e-9);
  for (const OutlineVertex& v : outline.loops[0].vertices) {
    if (v.part != Part::kEdge) continue;
    EXPECT_NEAR(std::fabs(v.position.y), 4.0, 1e-12);
  }
}

TEST(Outline, OfATJunctionIsTwoRectanglesAndTheCornersThatTheReturnsCutOff) {
  for (const double radius : {0.5, 3.0, 8.0, 12.0}) {
    const Outline outline = outline_of({straight(100.0, 8.0), branch(50.0, RoadSide::kLeft, 5.0, radius)});
    ASSERT_EQ(outline.loops.size(), 1U);
    const double corners = 2.0 * (1.0 - 0.25 * std::numbers::pi) * radius * radius;
    EXPECT_NEAR(area_of(outline.loops[0]), 800.0 + 36.0 * 5.0 + corners, 1e-3 * radius);
    const Mouth& mouth = outline.mouths.at(0);
    EXPECT_NEAR(mouth.begin_m, 50.0 - 2.5 - radius, 1e-8);
    EXPECT_NEAR(mouth.end_m, 50.0 + 2.5 + radius, 1e-8);
    EXPECT_NEAR(mouth.begin_branch_m, 4.0 + radius, 1e-8);
    EXPECT_NEAR(distance(mouth.begin_center, {47.5 - radius, 4.0 + radius}), 0.0, 1e-8);
  }
}

// Distance of a point from the edges of a road, as its definition has it.
double distance_from_edges(const Road& road, Vec2 p) {
  const Beside beside = road.line().nearest(p);
  return std::fabs(std::fabs(beside.lateral_m) - road.half_width(beside.station_m));
}

RC_GTEST_PROP(Outline, AReturnTouchesTheEdgesOfBothRoadsAtItsRadius, ()) {
  const double radius = *rc::gen::inRange(3, 121) / 10.0;
  const double angle = *rc::gen::inRange(60, 121);
  const double curvature = *rc::gen::inRange(-15, 16) / 1000.0;
  const RoadSide side = *rc::gen::element(RoadSide::kLeft, RoadSide::kRight);
  RoadConfig main = straight(100.0, 7.0);
  main.pieces = {{100.0, curvature}};
  RoadConfig side_road = branch(50.0, side, 5.0, radius, angle);
  side_road.pieces = {{60.0, 0.004}};
  const std::vector<Road> roads = make_roads({main, side_road});
  const Mouth mouth = make_outline(roads, 2.0).mouths.at(0);
  for (const Vec2 center : {mouth.begin_center, mouth.end_center}) {
    RC_ASSERT(std::fabs(distance_from_edges(roads[0], center) - radius) < 1e-7);
    RC_ASSERT(std::fabs(distance_from_edges(roads[1], center) - radius) < 1e-7);
  }
  RC_ASSERT(std::fabs(distance(mouth.begin, mouth.begin_center) - radius) < 1e-8);
  RC_ASSERT(std::fabs(distance(mouth.end, mouth.end_center) - radius) < 1e-8);
}

TEST(Outline, NoChordDepartsFromItsCurveByMoreThanHalfAMillimetre) {
  RoadConfig road = straight(60.0, 8.0);
  road.pieces = {{20.0}, {15.0, 0.0, 1.0 / 30.0}, {30.0, 1.0 / 30.0}};
  const std::vector<RoadConfig> configs = {road, branch(10.0, RoadSide::kRight, 4.0, 3.0)};
  const std::vector<Road> roads = make_roads(configs);
  const Outline outline = make_outline(roads, 2.0);
  const auto& vertices = outline.loops[0].vertices;
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    const OutlineVertex& a = vertices[i];
    const OutlineVertex& b = vertices[(i + 1) % vertices.size()];
    for (const double share : {0.25, 0.5, 0.75}) {
      const Vec2 p = a.position + share * (b.position - a.position);
      if (a.part == Part::kEdge) {
        EXPECT_LE(distance_from_edges(roads[a.road], p), kChordErrorMax_m);
      }
      if (a.part != Part::kReturn) continue;
      const Mouth& mouth = outline.mouths[0];
      const double to_arc = std::min(std::fabs(distance(p, mouth.begin_center) - 3.0),
                                     std::fabs(distance(p, mouth.end_center) - 3.0));
      EXPECT_LE(to_arc, kChordErrorMax_m);
    }
  }
}

TEST(Outline, ARingHasAnOutsideAndAHole) {
  RoadConfig ring = straight(1.0, 6.0);
  ring.closed = true;
  ring.pieces = {{2.0 * std::numbers::pi * 15.0, 1.0 / 15.0}};
  const Outline outline = outline_of({ring});
  ASSERT_EQ(outline.loops.size(), 2U);
  EXPECT_NEAR(area_of(outline.loops[0]), std::numbers::pi * 18.0 * 18.0, 0.1);
  EXPECT_NEAR(area_of(outline.loops[1]), -std::numbers::pi * 12.0 * 12.0, 0.1);
}

TEST(Outline, AnIslandIsAHoleWithRoundEnds) {
  RoadConfig road = straight(60.0, 10.0);
  road.islands = {{20.0, 1.0, 8.0, 2.0}};
  const Outline outline = outline_of({road});
  ASSERT_EQ(outline.loops.size(), 2U);
  EXPECT_TRUE(outline.loops[1].island);
  EXPECT_NEAR(area_of(outline.loops[1]), -(6.0 * 2.0 + std::numbers::pi), 2e-3);
  for (const OutlineVertex& v : outline.loops[1].vertices) {
    const double from_axis = distance(v.position, {std::clamp(v.position.x, 21.0, 27.0), 1.0});
    EXPECT_NEAR(from_axis, 1.0, 1e-9);
  }
}

TEST(Outline, ABayWidensTheRoadByItsDepth) {
  RoadConfig road = straight(60.0, 6.0);
  road.bays = {{RoadSide::kRight, 20.0, 10.0, 2.0, 1.5}};
  const Outline outline = outline_of({road});
  EXPECT_NEAR(area_of(outline.loops[0]), 360.0 + 2.0 * 11.5, 1e-9);
}

TEST(Outline, AGapLowersTheKerbOverItsWidthAndNoMore) {
  RoadConfig road = straight(60.0, 6.0);
  road.kerb_m = 0.12;
  road.gaps = {{RoadSide::kRight, 30.0, 2.0, 0.0, 0.5}};
  const std::vector<Road> roads = make_roads({road});
  EXPECT_DOUBLE_EQ(roads[0].step_height(RoadSide::kRight, 29.1), 0.0);
  EXPECT_DOUBLE_EQ(roads[0].step_height(RoadSide::kRight, 28.4), 0.12);
  EXPECT_NEAR(roads[0].step_height(RoadSide::kRight, 31.25), 0.06, 1e-12);
  EXPECT_DOUBLE_EQ(roads[0].step_height(RoadSide::kLeft, 30.0), 0.12);
}

TEST(Outline, TheWidthChangesEvenlyBetweenItsNodes) {
  RoadConfig road = straight(60.0, 6.0);
  road.widths = {{20.0, 6.0}, {40.0, 13.0}};
  const std::vector<Road> roads = make_roads({road});
  EXPECT_DOUBLE_EQ(roads[0].half_width(10.0), 3.0);
  EXPECT_DOUBLE_EQ(roads[0].half_width(30.0), 4.75);
  EXPECT_DOUBLE_EQ(roads[0].half_width(50.0), 6.5);
  EXPECT_NEAR(area_of(make_outline(roads, 2.0).loops[0]), 120.0 + 190.0 + 260.0, 1e-9);
}

TEST(Outline, RefusesWhatDoesNotFit) {
  const auto refuses = [](const std::vector<RoadConfig>& configs) {
    EXPECT_THROW((void)outline_of(configs), std::invalid_argument);
  };
  refuses({});
  refuses({straight(20.0, 8.0), branch(5.0, RoadSide::kLeft, 5.0, 8.0)});  // begins before the road does
  refuses({straight(100.0, 8.0), branch(50.0, RoadSide::kLeft, 5.0, 3.0),
           branch(56.0, RoadSide::kLeft, 5.0, 3.0)});
  refuses({branch(50.0, RoadSide::kLeft, 5.0, 3.0)});
  RoadConfig tight = straight(20.0, 8.0);
  tight.pieces = {{10.0, 0.3}};
  refuses({tight});
  RoadConfig island = straight(60.0, 6.0);
  island.islands = {{20.0, 2.5, 8.0, 2.0}};
  refuses({island});
  RoadConfig too_narrow = straight(60.0, 0.5);
  refuses({too_narrow});
}

TEST(OutlineIndex, FindsWhatTryingEveryStretchFinds) {
  RoadConfig road = straight(60.0, 8.0);
  road.pieces = {{30.0}, {30.0, 0.03}, {30.0, -0.02}};
  road.islands = {{20.0, 0.0, 6.0, 1.5}};
  const Outline outline = outline_of({road, branch(50.0, RoadSide::kRight, 5.0, 4.0)});
  const OutlineIndex index(outline);
  for (double x = -30.0; x < 130.0; x += 3.3) {
    for (double y = -60.0; y < 60.0; y += 2.9) {
      double least = std::numeric_limits<double>::infinity();
      bool inside = false;
      for (const OutlineLoop& loop : outline.loops) {
        std::vector<Vec2> line;
        for (const OutlineVertex& v : loop.vertices) line.push_back(v.position);
        line.push_back(line.front());
        least = std::min(least, distance_to(line, {x, y}));
        for (std::size_t i = 0; i + 1 < line.size(); ++i) {  // crossings to the right
          const Vec2 a = line[i];
          const Vec2 b = line[i + 1];
          if ((a.y > y) == (b.y > y)) continue;
          if (x < a.x + (y - a.y) / (b.y - a.y) * (b.x - a.x)) inside = !inside;
        }
      }
      const NearestEdge near = index.nearest({x, y});
      EXPECT_NEAR(std::fabs(near.outside_m), least, 1e-9);
      EXPECT_EQ(near.outside_m < 0.0, inside) << x << " " << y;
    }
  }
}

}  // namespace
}  // namespace verge::sim
