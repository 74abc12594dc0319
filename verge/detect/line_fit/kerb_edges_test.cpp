// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/detect/line_fit/kerb_edges.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "verge/detect/line_fit/street_scene.hpp"

namespace verge::detect::line_fit {
namespace {

using testing::Panel;
using testing::points_of;
using testing::Street;

KerbReturns returns_of(const Street& street, const std::vector<Object>& objects = {}) {
  return kerb_returns(points_of(street), objects, {});
}

/// The greatest distance of those points from a kerb at y.
double farthest_m(const Street& street, const std::vector<std::size_t>& returns, double y) {
  const auto points = points_of(street);
  double most = 0.0;
  for (const std::size_t i : returns) most = std::max(most, std::fabs(points[i].place.y - y));
  return most;
}

/// A car's two sides and its wheels, as the sensor sees them; the body begins 0.25 m above the road.
const Panel kRear{{12.0, -2.6}, {12.0, -0.9}, 0.25, 1.5};
const Panel kFlank{{12.0, -0.9}, {16.4, -0.9}, 0.25, 1.5};
const Panel kWheel{{12.6, -1.0}, {13.2, -1.0}, 0.0, 0.3};
Object car() {
  return {.type = ObjectClass::kCar, .center = {14.2, -1.75, 0.75}, .size = {4.4, 1.7, 1.5}, .yaw_rad = 0.0};
}

}  // namespace

TEST(KerbReturns, LieOnTheFacesOfBothKerbsAndNowhereElse) {
  const Street street;
  const KerbReturns returns = returns_of(street);
  EXPECT_GE(returns.left.size(), 30U);
  EXPECT_GE(returns.right.size(), 30U);
  EXPECT_LT(farthest_m(street, returns.left, 4.0), 0.07);
  EXPECT_LT(farthest_m(street, returns.right, -3.0), 0.07);
}

TEST(KerbReturns, AreMirroredWithTheStreet) {
  const KerbReturns returns = returns_of({.left_m = 4.0, .right_m = -3.0});
  const KerbReturns mirrored = returns_of({.left_m = 3.0, .right_m = -4.0});
  EXPECT_EQ(returns.left.size(), mirrored.right.size());
  EXPECT_EQ(returns.right.size(), mirrored.left.size());
}

TEST(KerbReturns, AreNoneWithoutAKerb) {
  const KerbReturns returns = returns_of({.kerb_m = 0.0});
  EXPECT_TRUE(returns.left.empty());
  EXPECT_TRUE(returns.right.empty());
  const KerbReturns nothing = kerb_returns({}, {}, {});
  EXPECT_TRUE(nothing.left.empty() && nothing.right.empty());
}

// What has something high above it is its foot.
TEST(KerbReturns, AreNotThoseOfAWall) {
  const Street wall{.kerb_m = 0.0, .panels = {{{2.0, -2.5}, {40.0, -2.5}, 0.0, 2.0}}};
  EXPECT_TRUE(returns_of(wall).right.empty());
}

TEST(KerbReturns, AreNotThoseOfAWheelOfAKnownCar) {
  const Street street{.panels = {kRear, kFlank, kWheel}};
  const KerbReturns returns = returns_of(street, {car()});
  ASSERT_FALSE(returns.right.empty());
  EXPECT_LT(farthest_m(street, returns.right, -3.0), 0.07);
}

// The kerb goes on behind what hides a part of it.
TEST(KerbReturns, AreOfOneKerbBeforeAndBehindABin) {
  const Street street{.panels = {{{9.0, -2.6}, {9.0, -2.2}, 0.0, 1.0}}};
  const auto points = points_of(street);
  const KerbReturns returns = returns_of(street);
  const auto ahead = [&](std::size_t i) { return points[i].place.x; };
  EXPECT_LT(ahead(*std::ranges::min_element(returns.right, {}, ahead)), 10.0);
  EXPECT_GT(ahead(*std::ranges::max_element(returns.right, {}, ahead)), 20.0);
}

TEST(KerbReturns, AreOfTheInnerOneOfTwoKerbs) {
  Street street{.left_m = 3.0};
  street.panels.push_back({{2.0, 6.0}, {40.0, 6.0}, 0.12, 0.24});  // a second step, behind the sidewalk
  const KerbReturns returns = returns_of(street);
  ASSERT_FALSE(returns.left.empty());
  EXPECT_LT(farthest_m(street, returns.left, 3.0), 0.07);
}

}  // namespace verge::detect::line_fit
