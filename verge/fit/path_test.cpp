// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/fit/path.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "verge/fit/test_points.hpp"

namespace verge::fit {
namespace {

TEST(Path, OrdersAlongADirectionThenFromRightToLeft) {
  const std::vector<Vec2> points{{2.0, 0.0}, {1.0, 1.0}, {1.0, -1.0}, {0.0, 5.0}};
  EXPECT_EQ(order_along(points, {1.0, 0.0}), (std::vector<std::size_t>{3, 2, 1, 0}));
  EXPECT_EQ(order_along(points, {0.0, -2.0}), (std::vector<std::size_t>{3, 1, 0, 2}));
}

TEST(Path, TheOrderDoesNotDependOnHowThePointsCame) {
  rc::check([](const testing::RawPlaces& raw) {
    auto points = testing::places_of(raw);
    const auto ordered = gather(points, order_along(points, {3.0, 1.0}));
    std::ranges::reverse(points);
    RC_ASSERT(gather(points, order_along(points, {3.0, 1.0})) == ordered);
    for (std::size_t i = 1; i < ordered.size(); ++i)
      RC_ASSERT(dot({3.0, 1.0}, ordered[i - 1]) <= dot({3.0, 1.0}, ordered[i]));
  });
}

TEST(Path, DropsPointsWithinACentimetreOfTheLastOneKept) {
  const std::vector<Vec2> points{{0.0, 0.0},   {0.006, 0.0}, {0.012, 0.0},
                                 {0.018, 0.0}, {1.0, 0.0},   {1.0, 0.0}};
  EXPECT_EQ(drop_duplicates(points), (std::vector<std::size_t>{0, 2, 4}));
  EXPECT_EQ(drop_duplicates(points, 0.001).size(), 5U);
  EXPECT_TRUE(drop_duplicates({}).empty());
}

TEST(Path, WhatIsLeftIsNeverCloserThanTheDuplicateDistance) {
  rc::check([](const testing::RawPlaces& raw) {
    const auto points = testing::places_of(raw);
    const auto kept = gather(points, drop_duplicates(points, 0.5));
    for (std::size_t i = 1; i < kept.size(); ++i) RC_ASSERT(distance(kept[i - 1], kept[i]) >= 0.5);
    RC_ASSERT(kept.empty() == points.empty());
  });
}

TEST(Path, ArcLengthsAddUpTheSegments) {
  EXPECT_EQ(arc_lengths(std::vector<Vec2>{{0.0, 0.0}, {3.0, 4.0}, {3.0, 5.0}}),
            (std::vector<double>{0.0, 5.0, 6.0}));
}

TEST(Path, MovingMeanTakesTheWindowOnBothSides) {
  const std::vector<Vec2> points{{0.0, 0.0}, {1.0, 0.0}, {2.0, 0.0}, {3.0, 0.0}, {4.0, 0.0}};
  std::vector<Vec2> bent = points;
  bent[2].y = 1e-6;
  const auto smooth = moving_mean(bent, 2.0);
  EXPECT_NEAR(smooth[2].y, 1e-6 / 3.0, 1e-15);
  EXPECT_NEAR(smooth[1].y, 1e-6 / 3.0, 1e-15);
  EXPECT_EQ(smooth[0], bent[0]);
  EXPECT_EQ(smooth[4], bent[4]);
}

TEST(Path, MovingMeanLeavesAnEvenStraightPathAlone) {
  std::vector<Vec2> points;
  for (int i = 0; i < 50; ++i) points.push_back({0.25 * i, 1.0 + 0.5 * i});
  const auto smooth = moving_mean(points, 3.0);
  for (std::size_t i = 0; i < points.size(); ++i) EXPECT_LT(distance(smooth[i], points[i]), 1e-12);
}

TEST(Path, MovingMeanOfNothingIsNothing) {
  EXPECT_TRUE(moving_mean({}, 1.0).empty());
  EXPECT_EQ(moving_mean(std::vector<Vec2>{{1.0, 2.0}}, 1.0), (std::vector<Vec2>{{1.0, 2.0}}));
}

}  // namespace
}  // namespace verge::fit
