// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/sim/seen.hpp"

#include <numbers>
#include <optional>
#include <vector>

#include <gtest/gtest.h>

namespace verge::sim {
namespace {

constexpr double kQuarter = 0.5 * std::numbers::pi;

/// A car of 4 m by 2 m with the number 7.
Object car(Vec2 center, double yaw_rad = 0.0) {
  Object object;
  object.id = 7;
  object.center = {center.x, center.y, 0.0};
  object.size = {4.0, 2.0, 1.5};
  object.yaw_rad = yaw_rad;
  object.confidence = 1.0;
  return object;
}

Scan returns_at(const std::vector<Vec2>& places, std::uint32_t object = 7) {
  Scan scan;
  for (const Vec2 p : places) {
    scan.x.push_back(static_cast<float>(p.x));
    scan.y.push_back(static_cast<float>(p.y));
    scan.z.push_back(0.0F);
    scan.label.push_back(object << 16U);
  }
  return scan;
}

Object seen(Object object, const Scan& scan) {
  std::vector<Object> objects = {object};
  tell_seen(objects, scan);
  return objects.front();
}

}  // namespace

TEST(Seen, ShapesAreThoseOfPaper2) {
  const std::vector<Vec2> rear = {{8.0, -0.5}, {8.0, 0.0}, {8.02, 0.5}};
  EXPECT_EQ(seen(car({10.0, 0.0}), returns_at(rear)).shape, ObjectShape::kFace);
  // Ahead on the left: the rear and the right flank.
  const std::vector<Vec2> left = {{8.0, 4.5}, {8.0, 5.0}, {8.0, 5.5}, {9.0, 4.0}, {10.0, 4.02}, {11.0, 3.98}};
  EXPECT_EQ(seen(car({10.0, 5.0}), returns_at(left)).shape, ObjectShape::kJ);
  std::vector<Vec2> right = left;
  for (Vec2& p : right) p.y = -p.y;
  EXPECT_EQ(seen(car({10.0, -5.0}), returns_at(right)).shape, ObjectShape::kL);
  // Whichever side of the box these faces are.
  EXPECT_EQ(seen(car({10.0, 5.0}, 2.0 * kQuarter), returns_at(left)).shape, ObjectShape::kJ);
  // Two returns on the flank are too few.
  EXPECT_EQ(seen(car({10.0, 5.0}), returns_at({left.begin(), left.end() - 1})).shape, ObjectShape::kFace);
}

TEST(Seen, AFaceThatLooksAwayHoldsNoReturns) {
  const std::vector<Vec2> through = {{8.0, -0.5}, {8.0, 0.0},  {8.0, 0.5},
                                     {12.0, 0.1}, {12.0, 0.0}, {12.0, 0.2}};
  EXPECT_EQ(seen(car({10.0, 0.0}), returns_at(through)).shape, ObjectShape::kFace);
}

TEST(Seen, WhatFewerThanThreeReturnsHitIsNotSeen) {
  const Object hidden = seen(car({10.0, 0.0}), returns_at({{8.0, 0.0}, {8.0, 0.1}}));
  EXPECT_EQ(hidden.shape, std::nullopt);
  EXPECT_EQ(hidden.confidence, 0.0);
  const Object anothers = seen(car({10.0, 0.0}), returns_at({{8.0, 0.0}, {8.0, 0.1}, {8.0, 0.2}}, 8));
  EXPECT_EQ(anothers.confidence, 0.0);
}

}  // namespace verge::sim
