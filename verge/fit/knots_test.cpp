// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/fit/knots.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace verge::fit {
namespace {

std::vector<Vec2> distinct_points(const std::vector<std::pair<std::uint8_t, std::int8_t>>& raw) {
  std::vector<Vec2> points;
  double x = 0.0;
  for (const auto& [dx, y] : raw) points.push_back({x += 0.01 + dx / 64.0, y / 16.0});
  return points;
}

TEST(Parameters, ChordLengthGoesByDistanceAndCentripetalByItsRoot) {
  const std::vector<Vec2> q{{0.0, 0.0}, {1.0, 0.0}, {1.0, 4.0}, {1.0, 13.0}};  // chords 1, 4, 9
  const auto chord = parameters(q, Parameterization::kChordLength).value();
  EXPECT_DOUBLE_EQ(chord[1], 1.0 / 14.0);
  EXPECT_DOUBLE_EQ(chord[2], 5.0 / 14.0);
  const auto centripetal = parameters(q, Parameterization::kCentripetal).value();
  EXPECT_DOUBLE_EQ(centripetal[1], 1.0 / 6.0);
  EXPECT_DOUBLE_EQ(centripetal[2], 3.0 / 6.0);
}

TEST(Parameters, OfTooFewOrCoincidingPointsAreNone) {
  EXPECT_FALSE(parameters({}, Parameterization::kCentripetal).has_value());
  EXPECT_FALSE(parameters(std::vector<Vec2>{{1.0, 1.0}}, Parameterization::kCentripetal).has_value());
  EXPECT_FALSE(parameters(std::vector<Vec2>(3, Vec2{1.0, 1.0}), Parameterization::kChordLength).has_value());
  const std::vector<Vec2> bad{{0.0, 0.0}, {std::nan(""), 1.0}};
  EXPECT_FALSE(parameters(bad, Parameterization::kChordLength).has_value());
}

TEST(Parameters, RunFromExactlyZeroToExactlyOneAndReverseWithThePoints) {
  rc::check([](const std::vector<std::pair<std::uint8_t, std::int8_t>>& raw, bool chord) {
    auto points = distinct_points(raw);
    RC_PRE(points.size() >= 2U);
    const auto kind = chord ? Parameterization::kChordLength : Parameterization::kCentripetal;
    const auto u = parameters(points, kind).value();
    RC_ASSERT(u.front() == 0.0 && u.back() == 1.0);
    RC_ASSERT(std::ranges::is_sorted(u));
    std::ranges::reverse(points);
    const auto reversed = parameters(points, kind).value();
    for (std::size_t i = 0; i < u.size(); ++i)
      RC_ASSERT(std::abs(reversed[i] - (1.0 - u[u.size() - 1 - i])) < 1e-12);
  });
}

TEST(Knots, AveragedOnesAreThoseOfTheNurbsBooksExample) {
  // Piegl and Tiller, example 9.1: Q = (0,0), (3,4), (-1,4), (-4,0), (-4,-3), p = 3, chord length:
  // u = 0, 5/17, 9/17, 14/17, 1 and the one interior knot is their mean 28/51.
  const std::vector<Vec2> q{{0.0, 0.0}, {3.0, 4.0}, {-1.0, 4.0}, {-4.0, 0.0}, {-4.0, -3.0}};
  const auto u = parameters(q, Parameterization::kChordLength).value();
  const auto knots = averaged_knots(u, 3);
  ASSERT_EQ(knots.size(), 9U);
  EXPECT_DOUBLE_EQ(u[1], 5.0 / 17.0);
  EXPECT_DOUBLE_EQ(u[2], 9.0 / 17.0);
  EXPECT_DOUBLE_EQ(u[3], 14.0 / 17.0);
  EXPECT_EQ(std::vector<double>(knots.begin(), knots.begin() + 4), std::vector<double>(4, 0.0));
  EXPECT_DOUBLE_EQ(knots[4], 28.0 / 51.0);
  EXPECT_EQ(std::vector<double>(knots.begin() + 5, knots.end()), std::vector<double>(4, 1.0));
}

TEST(Knots, UniformOnesDivideTheInteriorEvenly) {
  EXPECT_EQ(uniform_knots(7, 3),
            (std::vector<double>{0.0, 0.0, 0.0, 0.0, 0.25, 0.5, 0.75, 1.0, 1.0, 1.0, 1.0}));
  EXPECT_EQ(uniform_knots(2, 1), (std::vector<double>{0.0, 0.0, 1.0, 1.0}));
}

TEST(Knots, LeastSquaresOnesFollowEquation968) {
  // 9 parameters k / 8 and 6 control points, p = 3: d = 9 / 3 = 3, so that the knots are u_2 and u_5.
  std::vector<double> u;
  for (int k = 0; k <= 8; ++k) u.push_back(k / 8.0);
  const auto knots = least_squares_knots(u, 6, 3);
  ASSERT_EQ(knots.size(), 10U);
  EXPECT_DOUBLE_EQ(knots[4], 2.0 / 8.0);
  EXPECT_DOUBLE_EQ(knots[5], 5.0 / 8.0);
  // 5 control points: d = 9 / 2, i = 4, alpha = 0.5: half way between u_3 and u_4.
  EXPECT_DOUBLE_EQ(least_squares_knots(u, 5, 3)[4], 3.5 / 8.0);
}

TEST(Knots, LeastSquaresOnesLeaveNoSpanWithoutParameters) {
  rc::check([](const std::vector<std::pair<std::uint8_t, std::int8_t>>& raw) {
    const auto points = distinct_points(raw);
    RC_PRE(points.size() >= 5U);
    const auto u = parameters(points, Parameterization::kChordLength).value();
    const auto control = *rc::gen::inRange<std::size_t>(4, points.size());
    const auto knots = least_squares_knots(u, control, 3);
    RC_ASSERT(knots.size() == control + 4);
    for (std::size_t k = 3; k < control; ++k) {
      const bool holds = std::ranges::any_of(u, [&](double v) { return knots[k] <= v && v <= knots[k + 1]; });
      RC_ASSERT(holds);
    }
  });
}

}  // namespace
}  // namespace verge::fit
