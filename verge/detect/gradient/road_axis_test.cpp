// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/detect/gradient/road_axis.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "verge/core/angle.hpp"

namespace verge::detect::gradient {
namespace {

constexpr double kRadius = 40.0;     // of the bend to the left
constexpr double kHalfWidth = 3.0;   // of the road
constexpr double kOffCentre = -1.5;  // the vehicle keeps right

/// The road's bend: the centre of its circle lies to the left.
const Vec2 kCentre{0.0, kRadius - kOffCentre};

/// How far left of the road's middle a point lies.
double lateral(Vec2 p) { return kRadius - distance(p, kCentre); }

LowRing ring_of(double range_m) {
  LowRing ring{0, 0.0, 0.003, {}};
  for (double azimuth = -std::numbers::pi; azimuth < std::numbers::pi; azimuth += ring.spacing_rad)
    ring.points.push_back({range_m * std::cos(azimuth), range_m * std::sin(azimuth), 0.0});
  return ring;
}

/// Where the ring meets the kerb of one side, ahead or behind; none where it does not.
std::optional<Vec2> foot(const LowRing& ring, bool front, bool right) {
  const double side = right ? -kHalfWidth : kHalfWidth;
  for (std::size_t i = 1; i < ring.points.size(); ++i) {
    const Vec2 a = ring.points[i - 1].xy();
    const Vec2 b = ring.points[i].xy();
    const bool crosses = (lateral(a) < side) != (lateral(b) < side);
    if (crosses && (a.x >= 0.0) == front) return a;
  }
  return std::nullopt;
}

TEST(RoadAxis, StaysOnTheRoadThroughABend) {
  for (const bool front : {true, false}) {
    RoadAxis axis(front);
    for (const double range : {3.2, 4.0, 5.0, 6.0, 7.5, 9.0, 11.5, 13.5, 16.0, 20.0, 27.0}) {
      const LowRing ring = ring_of(range);
      axis.advance(ring);
      const Vec2 place = (range / norm(axis.direction())) * axis.direction();
      EXPECT_LT(std::abs(lateral(place)), kHalfWidth - 0.2) << range;
      axis.follow(foot(ring, front, false), foot(ring, front, true));
    }
    EXPECT_GT(std::abs(axis.direction().y), 5.0);  // the vehicle's axis has long left the road
  }
}

TEST(RoadAxis, WithoutBoundariesIsTheVehiclesAxis) {
  RoadAxis axis(false);
  EXPECT_EQ(axis.direction(), (Vec2{-1.0, 0.0}));
  for (const double range : {4.0, 9.0, 20.0}) {
    axis.advance(ring_of(range));
    axis.follow(std::nullopt, std::nullopt);
  }
  EXPECT_NEAR(axis.direction().x, -20.0, 1e-3);
  EXPECT_NEAR(axis.direction().y, 0.0, 1e-9);
}

TEST(RoadAxis, AFootFarAsideDoesNotTurnIt) {
  RoadAxis axis(true);
  for (const double range : {4.0, 6.0, 8.0, 10.0, 12.0}) {
    axis.advance(ring_of(range));
    axis.follow(Vec2{range, 3.0}, range == 8.0 ? Vec2{8.0, -9.0} : Vec2{range, -3.0});
  }
  EXPECT_NEAR(axis.direction().y, 0.0, 1e-9);
}

TEST(RoadAxis, AForkDoesNotTurnIt) {
  RoadAxis axis(true);
  for (const double range : {4.0, 6.0, 8.0, 10.0, 12.0, 14.0, 16.0}) {
    const double aside = 3.0 + 0.18 * (range - 4.0);  // both sides leave by 10 degrees and more
    axis.advance(ring_of(range));
    axis.follow(Vec2{range, aside}, Vec2{range, -aside - 0.05 * range});
  }
  EXPECT_NEAR(axis.direction().y, 0.0, 1e-9);
}

TEST(RoadAxis, PartsAreOrderedFromTheAxisOutward) {
  const LowRing ring = ring_of(10.0);
  for (const bool front : {true, false}) {
    const Vec2 axis = front ? Vec2{9.0, 3.0} : Vec2{-9.0, 3.0};
    std::size_t points = 0;
    for (const QuadrantRing& part : parts_of(ring, front, axis)) {
      EXPECT_EQ(is_front(part.region), front);
      ASSERT_FALSE(part.points.empty());
      EXPECT_LT(distance(part.points.front().xy(), {(front ? 1.0 : -1.0) * 9.487, 3.162}), 0.05);
      EXPECT_NEAR(part.points.back().y, is_right(part.region) ? -10.0 : 10.0, 0.01);
      points += part.points.size();
    }
    const auto is_in_half = [front](Vec3 p) { return (p.x >= 0.0) == front; };
    EXPECT_EQ(points, std::count_if(ring.points.begin(), ring.points.end(), is_in_half));
  }
}

}  // namespace
}  // namespace verge::detect::gradient
