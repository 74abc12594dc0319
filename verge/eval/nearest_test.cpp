// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/eval/nearest.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "verge/core/polyline.hpp"
#include "verge/eval/join_points.hpp"

namespace verge::eval {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

Vec2 any_place() { return {*rc::gen::inRange(-50, 50) * 0.1, *rc::gen::inRange(-50, 50) * 0.1}; }

std::vector<Vec2> any_places() {
  std::vector<Vec2> places;
  for (int i = *rc::gen::inRange(0, 20); i > 0; --i) places.push_back(any_place());
  return places;
}

double cut_at(double limit, double distance) { return distance < limit ? distance : kInfinity; }

RC_GTEST_PROP(NearestPoint, IsTheLeastOfAllDistancesBelowTheLimit, ()) {
  const std::vector<Vec2> places = any_places();
  const Vec2 p = any_place();
  double least = kInfinity;
  for (const Vec2 q : places) least = std::min(least, std::hypot(p.x - q.x, p.y - q.y));
  RC_ASSERT(NearestPoint(places, 2.0).distance(p) == cut_at(2.0, least));
}

RC_GTEST_PROP(NearestSegment, IsTheLeastOfAllDistancesBelowTheLimit, ()) {
  std::vector<Segment> segments;
  for (int i = *rc::gen::inRange(0, 20); i > 0; --i) segments.push_back({any_place(), any_place()});
  const Vec2 p = any_place();
  double least = kInfinity;
  for (const Segment& s : segments) least = std::min(least, distance_to(std::array{s.a, s.b}, p));
  const double found = NearestSegment(segments, 2.0).distance(p);
  RC_ASSERT(std::isfinite(found) == (least < 2.0) || std::fabs(least - 2.0) < 1e-9);
  if (std::isfinite(found)) RC_ASSERT(std::fabs(found - least) < 1e-12);
}

TEST(NearestSegment, WithoutSegmentsEverythingIsFar) {
  EXPECT_EQ(NearestSegment({}, 1.0).distance({0.0, 0.0}), kInfinity);
  EXPECT_EQ(NearestPoint({}, 1.0).distance({0.0, 0.0}), kInfinity);
}

TEST(JoinNear, APointIsJoinedToItsTwoNearestNeighboursWithinReach) {
  const std::vector<Vec2> points{{0.0, 0.0}, {1.0, 0.0}, {2.2, 0.0}, {9.0, 0.0}};
  const std::vector<Segment> segments = join_near(points);
  const std::vector<Segment> expected{
      {points[0], points[1]}, {points[1], points[0]}, {points[1], points[2]}, {points[2], points[1]}};
  EXPECT_EQ(segments, expected);
}

TEST(JoinRings, APointGoesOnInTheNextRingElseInTheOneAfterIt) {
  const RingPoint first{{5.0, 3.0}, 0};
  const RingPoint second{{6.0, 3.0}, 1};
  const RingPoint fourth{{8.0, 3.0}, 3};
  const std::vector<Segment> segments = join_rings(std::vector{first, second, fourth});
  const std::vector<Segment> expected{{first.place, second.place}, {second.place, fourth.place}};
  EXPECT_EQ(segments, expected);
}

TEST(JoinRings, NoFartherThanTheRingsAreApartAllows) {
  // Of one range: 1 m is allowed, and these are 1.99 m apart.
  const std::vector<RingPoint> across{{{5.0, 0.0}, 0}, {{5.0 * std::cos(0.4), 5.0 * std::sin(0.4)}, 1}};
  EXPECT_TRUE(join_rings(across).empty());
  const std::vector<RingPoint> beyond_8m{{{10.0, 0.0}, 0}, {{18.5, 0.0}, 1}};
  EXPECT_TRUE(join_rings(beyond_8m).empty());
}

}  // namespace
}  // namespace verge::eval
