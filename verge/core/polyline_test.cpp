// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/core/polyline.hpp"

#include <limits>

#include <gtest/gtest.h>

namespace verge {
namespace {

const std::vector<Vec2> kElbow{{0.0, 0.0}, {3.0, 0.0}, {3.0, 4.0}};

TEST(Polyline, LengthIsTheSumOfItsSegments) {
  EXPECT_DOUBLE_EQ(length(kElbow), 7.0);
  EXPECT_DOUBLE_EQ(length(std::vector<Vec2>{{1.0, 1.0}}), 0.0);
  EXPECT_DOUBLE_EQ(length({}), 0.0);
}

TEST(Polyline, ResamplingGoesRoundTheCorner) {
  const auto points = resample(kElbow, 2.0);
  ASSERT_EQ(points.size(), 4U);
  EXPECT_DOUBLE_EQ(points[1].x, 2.0);
  EXPECT_DOUBLE_EQ(points[2].x, 3.0);
  EXPECT_DOUBLE_EQ(points[2].y, 1.0);
  EXPECT_DOUBLE_EQ(points[3].y, 3.0);
}

TEST(Polyline, ResamplingMeetsTheEndWhereTheSpacingDoes) {
  EXPECT_EQ(resample(kElbow, 0.1).size(), 71U);
  EXPECT_EQ(resample(std::vector<Vec2>{{1.0, 1.0}, {1.0, 1.0}}, 0.1).size(), 1U);
}

TEST(Polyline, DistanceIsToTheNearestSegmentOrEnd) {
  EXPECT_DOUBLE_EQ(distance_to(kElbow, {1.0, 2.0}), 2.0);
  EXPECT_DOUBLE_EQ(distance_to(kElbow, {-3.0, 4.0}), 5.0);
  EXPECT_DOUBLE_EQ(distance_to(std::vector<Vec2>{{0.0, 0.0}}, {3.0, 4.0}), 5.0);
  EXPECT_EQ(distance_to({}, {0.0, 0.0}), std::numeric_limits<double>::infinity());
}

}  // namespace
}  // namespace verge
