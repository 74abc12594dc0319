// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/sim/center_line.hpp"

#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "verge/core/angle.hpp"

namespace verge::sim {
namespace {

constexpr double kRadius_m = 30.0;
constexpr double kQuarter_m = 0.5 * std::numbers::pi * kRadius_m;

std::vector<Piece> straight_then(double radius_m) { return {{60.0}, {kQuarter_m, 1.0 / radius_m}}; }

TEST(CenterLine, AQuarterTurnEndsOneRadiusOnAndOneRadiusAside) {
  const CenterLine line(straight_then(kRadius_m));
  EXPECT_NEAR(line.length_m(), 60.0 + kQuarter_m, 1e-12);
  const Station end = line.at(line.length_m());
  EXPECT_NEAR(end.position.x, 60.0 + kRadius_m, 1e-9);
  EXPECT_NEAR(end.position.y, kRadius_m, 1e-9);
  EXPECT_NEAR(rad_to_deg(end.heading_rad), 90.0, 1e-9);
}

TEST(CenterLine, ARightTurnIsTheMirrorImageOfALeftTurn) {
  const CenterLine left(straight_then(kRadius_m));
  const CenterLine right(straight_then(-kRadius_m));
  for (double s = 0.0; s < left.length_m(); s += 3.7) {
    EXPECT_NEAR(left.at(s).position.x, right.at(s).position.x, 1e-9);
    EXPECT_NEAR(left.at(s).position.y, -right.at(s).position.y, 1e-9);
  }
}

TEST(CenterLine, GoesOnStraightBeyondItsEnds) {
  const CenterLine line(straight_then(kRadius_m));
  EXPECT_NEAR(line.at(-7.0).position.x, -7.0, 1e-12);
  const Station beyond = line.at(line.length_m() + 5.0);
  EXPECT_NEAR(beyond.position.x, 90.0, 1e-9);
  EXPECT_NEAR(beyond.position.y, 35.0, 1e-9);
}

// The oracle: Simpson's rule over the heading, which is a polynomial of the arc length.
Vec2 by_simpson(double curvature, double change, double length) {
  constexpr int kSteps = 20000;
  Vec2 sum;
  for (int i = 0; i <= kSteps; ++i) {
    const double u = length * i / kSteps;
    const double heading = u * (curvature + 0.5 * change / length * u);
    const double weight = i == 0 || i == kSteps ? 1.0 : (i % 2 == 1 ? 4.0 : 2.0);
    sum = sum + weight * Vec2{std::cos(heading), std::sin(heading)};
  }
  return (length / kSteps / 3.0) * sum;
}

RC_GTEST_PROP(CenterLine, AClothoidEndsWhereNumericalIntegrationSays, ()) {
  const double curvature = *rc::gen::inRange(-200, 201) / 1000.0;
  const double change = *rc::gen::inRange(-300, 301) / 1000.0;
  const double length = *rc::gen::inRange(1, 80);
  const CenterLine line({{length, curvature, change}});
  const Vec2 expected = by_simpson(curvature, change, length);
  const Station end = line.at(length - 1e-13);
  RC_ASSERT(distance(end.position, expected) < 1e-10);
  RC_ASSERT(std::fabs(end.heading_rad - length * (curvature + 0.5 * change)) < 1e-11);
}

TEST(CenterLine, AClothoidFromStraightFollowsTheFresnelIntegrals) {
  // With curvature pi s the place is (C(s), S(s)); values from Abramowitz and Stegun, table 7.7.
  const CenterLine line({{2.0, 0.0, 2.0 * std::numbers::pi}});
  EXPECT_NEAR(line.at(1.0).position.x, 0.7798934, 5e-8);
  EXPECT_NEAR(line.at(1.0).position.y, 0.4382591, 5e-8);
  EXPECT_NEAR(line.at(2.0 - 1e-12).position.x, 0.4882534, 5e-8);
  EXPECT_NEAR(line.at(2.0 - 1e-12).position.y, 0.3434157, 5e-8);
}

RC_GTEST_PROP(CenterLine, IsRunAtUnitSpeedAlongItsHeading, ()) {
  const double curvature = *rc::gen::inRange(-40, 41) / 1000.0;
  const CenterLine line({{20.0}, {10.0, 0.0, curvature}, {30.0, curvature}, {25.0, curvature, -curvature}});
  const double s = *rc::gen::inRange(1, 8400) / 100.0;
  const double h = 1e-4;
  const Vec2 step = line.at(s + h).position - line.at(s).position;
  RC_ASSERT(std::fabs(norm(step) - h) < 1e-10);
  RC_ASSERT(std::fabs(cross(along(line.at(s).heading_rad), step)) < 1e-8);
}

TEST(CenterLine, IsStraightOnlyWhereNothingBends) {
  const CenterLine line({{60.0}, {10.0, 0.0, 0.03}, {20.0, 0.03}});
  EXPECT_TRUE(line.is_straight(0.0, 60.0));
  EXPECT_TRUE(line.is_straight(-20.0, 30.0));
  EXPECT_FALSE(line.is_straight(50.0, 60.1));
  EXPECT_FALSE(line.is_straight(75.0, 80.0));
}

RC_GTEST_PROP(CenterLine, TheNearestPlaceOfAPointBesideIsWhereThePointWasPut, ()) {
  const CenterLine line({{30.0}, {15.0, 0.0, 0.03}, {30.0, 0.03}, {15.0, 0.03, -0.03}, {30.0}});
  const double s = *rc::gen::inRange(10, 11900) / 100.0;
  const double lateral = *rc::gen::inRange(-1500, 1501) / 100.0;
  const Beside found = line.nearest(line.point(s, lateral));
  RC_ASSERT(std::fabs(found.station_m - s) < 1e-6);
  RC_ASSERT(std::fabs(found.lateral_m - lateral) < 1e-8);
}

TEST(CenterLine, AClosedLineGoesRound) {
  const CenterLine ring({{2.0 * std::numbers::pi * 14.0, 1.0 / 14.0}},
                        {{14.0, 0.0}, 0.5 * std::numbers::pi, 0.0}, true);
  for (double s = -100.0; s < 300.0; s += 17.0) EXPECT_NEAR(norm(ring.at(s).position), 14.0, 1e-9);
  EXPECT_NEAR(distance(ring.at(3.0).position, ring.at(3.0 + ring.length_m()).position), 0.0, 1e-9);
  EXPECT_NEAR(ring.nearest({0.0, -20.0}).lateral_m, -6.0, 1e-9);
}

TEST(CenterLine, RefusesWhatIsNoLine) {
  const auto refuses = [](const std::vector<Piece>& pieces, bool closed) {
    EXPECT_THROW(CenterLine(pieces, {}, closed), std::invalid_argument);
  };
  refuses({}, false);
  refuses({{0.0}}, false);
  refuses({{10.0, std::numeric_limits<double>::quiet_NaN()}}, false);
  refuses({{10.0}}, true);
}

}  // namespace
}  // namespace verge::sim
