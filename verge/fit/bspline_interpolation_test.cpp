// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/fit/bspline_interpolation.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "verge/fit/test_points.hpp"

namespace verge::fit {
namespace {

const std::vector<Vec2> kBend{{0.0, 0.0}, {4.0, 0.2}, {7.0, 1.0}, {9.0, 3.0}, {9.5, 6.0}, {9.6, 12.0}};

/// The greatest distance of a key point from the curve at its own parameter.
double greatest_residual(const BSpline& curve, const std::vector<Vec2>& q, Parameterization kind) {
  const auto u = parameters(q, kind).value();
  double greatest = 0.0;
  for (std::size_t k = 0; k < q.size(); ++k)
    greatest = std::max(greatest, distance(evaluate(curve, u[k]), q[k]));
  return greatest;
}

TEST(Interpolation, GoesThroughTheKeyPointsOfTheNurbsBooksExample) {
  // Example 9.1 of Piegl and Tiller; see knots_test.cpp for its parameters and knots.
  const std::vector<Vec2> q{{0.0, 0.0}, {3.0, 4.0}, {-1.0, 4.0}, {-4.0, 0.0}, {-4.0, -3.0}};
  const auto curve = interpolate(q, {.parameterization = Parameterization::kChordLength}).value();
  EXPECT_EQ(curve.degree, 3U);
  EXPECT_EQ(curve.control_points.size(), 5U);
  EXPECT_LT(greatest_residual(curve, q, Parameterization::kChordLength), 1e-12);
}

TEST(Interpolation, ResidualsStayBelowANanometre) {
  rc::check([](const testing::RawSteps& raw, bool chord) {
    const auto q = testing::steps_of(raw);
    RC_PRE(q.size() >= 2U);
    const auto kind = chord ? Parameterization::kChordLength : Parameterization::kCentripetal;
    const auto curve = interpolate(q, {.parameterization = kind});
    RC_ASSERT(curve.has_value());
    RC_ASSERT(greatest_residual(*curve, q, kind) < 1e-9);
  });
}

TEST(Interpolation, ResidualsStayBelowANanometreOnAThousandKeyPoints) {
  std::vector<Vec2> q;
  for (int i = 0; i < 1000; ++i) q.push_back({0.1 * i, std::sin(0.05 * i) + 0.02 * ((i * 7919) % 11)});
  const auto curve = interpolate(q).value();
  EXPECT_LT(greatest_residual(curve, q, Parameterization::kCentripetal), 1e-9);
}

TEST(Interpolation, OfPointsOnALineStaysOnTheLine) {
  const auto on_line = [](double s) { return Vec2{1.0 + 0.6 * s, 2.0 + 0.8 * s}; };
  std::vector<Vec2> q;
  for (const double s : {0.0, 0.5, 3.0, 3.2, 9.0, 14.0}) q.push_back(on_line(s));
  const auto curve = interpolate(q).value();
  for (int i = 0; i <= 100; ++i)
    EXPECT_NEAR(cross({0.6, 0.8}, evaluate(curve, i / 100.0) - q.front()), 0.0, 1e-12);
}

TEST(Interpolation, OfFewKeyPointsLowersTheDegree) {
  const auto line = interpolate(std::vector<Vec2>{{0.0, 0.0}, {4.0, 2.0}}).value();
  EXPECT_EQ(line.degree, 1U);
  EXPECT_EQ(evaluate(line, 0.5), (Vec2{2.0, 1.0}));
  const std::vector<Vec2> three{{0.0, 0.0}, {1.0, 1.0}, {2.0, 0.0}};
  const auto parabola = interpolate(three).value();
  EXPECT_EQ(parabola.degree, 2U);
  EXPECT_LT(distance(evaluate(parabola, 0.25), {0.5, 0.75}), 1e-12);
  EXPECT_EQ(interpolate(std::span(kBend).first(4)).value().degree, 3U);
}

TEST(Interpolation, OfRepeatedOrTooFewPointsIsNone) {
  EXPECT_FALSE(interpolate({}).has_value());
  EXPECT_FALSE(interpolate(std::vector<Vec2>{{1.0, 1.0}}).has_value());
  EXPECT_FALSE(interpolate(std::vector<Vec2>{{0.0, 0.0}, {0.0, 0.0}}).has_value());
  EXPECT_FALSE(interpolate(std::vector<Vec2>{{0.0, 0.0}, {1.0, 0.0}, {1.0, 0.0}, {2.0, 0.0}}).has_value());
}

TEST(Interpolation, OnUniformKnotsGoesThroughEvenlySpacedPoints) {
  std::vector<Vec2> q;
  for (int i = 0; i < 9; ++i) q.push_back({1.0 * i, 0.3 * (i % 3)});
  const InterpolationOptions uniform{.knots = KnotPlacement::kUniform};
  const auto curve = interpolate(q, uniform).value();
  EXPECT_EQ(curve.knots, uniform_knots(9, 3));
  EXPECT_LT(greatest_residual(curve, q, Parameterization::kCentripetal), 1e-9);
}

TEST(Interpolation, OnUniformKnotsIsNoneWherePointsCrowd) {
  std::vector<Vec2> q{{0.0, 0.0}};
  for (int i = 0; i < 12; ++i) q.push_back({100.0 + 0.02 * i, 0.0});
  EXPECT_FALSE(
      interpolate(q, {.parameterization = Parameterization::kChordLength, .knots = KnotPlacement::kUniform})
          .has_value());
  EXPECT_TRUE(interpolate(q, {.parameterization = Parameterization::kChordLength}).has_value());
}

TEST(Interpolation, ReversedPointsGiveTheSameCurveBackwards) {
  rc::check([](const testing::RawSteps& raw) {
    auto q = testing::steps_of(raw);
    RC_PRE(q.size() >= 2U);
    const auto there = interpolate(q).value();
    std::ranges::reverse(q);
    const auto back = interpolate(q).value();
    for (int i = 0; i <= 20; ++i)
      RC_ASSERT(distance(evaluate(there, i / 20.0), evaluate(back, 1.0 - i / 20.0)) < 1e-7);
  });
}

TEST(Interpolation, MovesAndTurnsWithItsPoints) {
  std::vector<Vec2> moved;
  for (const Vec2 p : kBend) moved.push_back({100.0 - p.y, p.x - 50.0});
  const auto before = interpolate(kBend).value();
  const auto after = interpolate(moved).value();
  for (int i = 0; i <= 50; ++i) {
    const Vec2 p = evaluate(before, i / 50.0);
    EXPECT_LT(distance(evaluate(after, i / 50.0), {100.0 - p.y, p.x - 50.0}), 1e-11);
  }
}

TEST(Interpolation, CentripetalParametersOvershootLessThanChordLengthAtASharpTurn) {
  // Long straights about a short step: the case that centripetal parameters were made for (Lee 1989).
  const std::vector<Vec2> q{{0.0, 0.0}, {10.0, 0.0}, {10.1, 0.5}, {20.0, 0.5}};
  const auto overshoot = [&](Parameterization kind) {
    const auto curve = interpolate(q, {.parameterization = kind}).value();
    double greatest = 0.0;
    for (const Vec2 p : sample(curve, 0.05)) greatest = std::max({greatest, -p.y, p.y - 0.5});
    return greatest;
  };
  EXPECT_LT(overshoot(Parameterization::kCentripetal), 0.6 * overshoot(Parameterization::kChordLength));
}

}  // namespace
}  // namespace verge::fit
