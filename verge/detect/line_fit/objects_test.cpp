// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/detect/line_fit/objects.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "verge/core/angle.hpp"
#include "verge/core/field_io.hpp"
#include "verge/detect/line_fit/box.hpp"

namespace verge::detect::line_fit {
namespace {

constexpr double kHeight_m = 0.5;

/// A rectangle seen from above: what stands.
struct Block {
  Vec2 center;
  double length_m = 4.4;
  double width_m = 1.8;
  double yaw_rad = 0.0;
};

Block car(double x, double y, double yaw_deg = 0.0) { return {{x, y}, 4.4, 1.8, deg_to_rad(yaw_deg)}; }
Block person(double x, double y) { return {{x, y}, 0.45, 0.45, 0.0}; }

/// Where the ray meets the block, metres on; none where it passes.
std::optional<double> hit(const Block& block, double azimuth_rad) {
  const Vec2 ray{std::cos(azimuth_rad), std::sin(azimuth_rad)};
  const Vec2 along{std::cos(block.yaw_rad), std::sin(block.yaw_rad)};
  double enter = 0.0;
  double leave = std::numeric_limits<double>::infinity();
  for (const auto& [axis, half] :
       {std::pair{along, 0.5 * block.length_m}, {Vec2{-along.y, along.x}, 0.5 * block.width_m}}) {
    const double from = dot(axis, block.center);
    const double speed = dot(axis, ray);
    const double a = (from - half) / speed;
    const double b = (from + half) / speed;
    enter = std::max(enter, std::min(a, b));
    leave = std::min(leave, std::max(a, b));
  }
  return enter < leave ? std::optional(enter) : std::nullopt;
}

/// What layers 0.3 to 0.45 m above the road see of the blocks, every quarter degree within 50 degrees.
std::vector<LayerPoint> seen(const std::vector<Block>& blocks, double sigma_m = 0.0) {
  std::mt19937 engine(7);
  std::normal_distribution<double> noise(0.0, 1.0);
  std::vector<LayerPoint> points;
  for (std::size_t layer = 0; layer < 4; ++layer) {
    for (double deg = 50.0; deg >= -50.0; deg -= 0.25) {
      std::optional<double> nearest;
      for (const Block& block : blocks) {
        const auto range = hit(block, deg_to_rad(deg));
        if (range && (!nearest || *range < *nearest)) nearest = range;
      }
      if (!nearest) continue;
      const double range_m = *nearest + sigma_m * noise(engine);
      const double z = 0.3 + 0.05 * static_cast<double>(layer);
      points.push_back({{range_m * std::cos(deg_to_rad(deg)), range_m * std::sin(deg_to_rad(deg)), z},
                        layer,
                        deg_to_rad(deg),
                        std::hypot(range_m, kHeight_m - z),
                        points.size()});
    }
  }
  return points;
}

std::vector<FoundObject> found(const std::vector<Block>& blocks, double sigma_m = 0.0,
                               const RoadSides& road = {}) {
  return find_objects(seen(blocks, sigma_m), kHeight_m, {}, road);
}

bool holds(const Object& object, Vec2 p) {
  const Vec2 d = p - object.center.xy();
  const Vec2 along{std::cos(object.yaw_rad), std::sin(object.yaw_rad)};
  return std::fabs(dot(d, along)) <= 0.5 * object.size.length_m &&
         std::fabs(cross(along, d)) <= 0.5 * object.size.width_m;
}

/// Intersection over union, by cells of 5 cm.
double overlap(const Object& object, const Block& block) {
  Object true_object;
  true_object.center = {block.center.x, block.center.y, 0.0};
  true_object.size = {block.length_m, block.width_m, 1.5};
  true_object.yaw_rad = block.yaw_rad;
  std::size_t both = 0;
  std::size_t any = 0;
  for (double x = -6.0; x < 6.0; x += 0.05) {
    for (double y = -6.0; y < 6.0; y += 0.05) {
      const Vec2 p = block.center + Vec2{x, y};
      const bool in_a = holds(object, p);
      const bool in_b = holds(true_object, p);
      both += in_a && in_b ? 1 : 0;
      any += in_a || in_b ? 1 : 0;
    }
  }
  return static_cast<double>(both) / static_cast<double>(any);
}

double heading_error(const Object& object, double yaw_rad) {
  return std::fabs(std::remainder(object.yaw_rad - yaw_rad, std::numbers::pi));
}

/// Of each class, how many.
std::size_t count(const std::vector<FoundObject>& objects, ObjectClass type) {
  return static_cast<std::size_t>(
      std::ranges::count_if(objects, [=](const FoundObject& o) { return o.object.type == type; }));
}

}  // namespace

// Bar 1 of paper 2 (P2-17): "-" opposite, "J" to the left, "L" to the right of the laser.
TEST(Objects, CarsLeftRightAndAheadHaveTheirSigns) {
  struct Row {
    Block block;
    ObjectShape shape;
  };
  for (const Row& row :
       {Row{car(12.0, 0.0), ObjectShape::kFace}, Row{car(12.0, 4.0), ObjectShape::kJ},
        Row{car(12.0, -4.0), ObjectShape::kL}, Row{car(12.0, 0.0, 180.0), ObjectShape::kFace},
        Row{car(15.0, 4.0, 180.0), ObjectShape::kJ}, Row{car(12.0, -4.0, 10.0), ObjectShape::kL}}) {
    const auto objects = found({row.block});
    ASSERT_EQ(objects.size(), 1U);
    EXPECT_EQ(objects[0].object.shape, row.shape) << row.block.center.x << ' ' << row.block.center.y;
    EXPECT_EQ(objects[0].object.type, ObjectClass::kCar);
    EXPECT_GT(overlap(objects[0].object, row.block), 0.9);
    EXPECT_GT(objects[0].object.confidence, 0.8);
  }
}

TEST(Objects, TheHeadingOfAnyCarOfTwoFacesIsWithinHalfADegree) {
  for (double yaw_deg = -80.0; yaw_deg < 90.0; yaw_deg += 10.0) {
    const Block block = car(11.0, 4.0, yaw_deg);
    const auto objects = found({block}, 0.01);
    ASSERT_EQ(objects.size(), 1U) << yaw_deg;
    EXPECT_EQ(objects[0].object.type, ObjectClass::kCar) << yaw_deg;
    EXPECT_LT(heading_error(objects[0].object, block.yaw_rad), deg_to_rad(0.5)) << yaw_deg;
    EXPECT_GT(overlap(objects[0].object, block), 0.9) << yaw_deg;
  }
}

TEST(Objects, ParkedCarsNinetyCentimetresApartStayTwo) {
  const std::vector<Block> cars = {car(8.0, -2.5), car(13.3, -2.5), car(18.6, -2.5)};
  const auto objects = found(cars, 0.03);
  ASSERT_EQ(objects.size(), 3U);
  for (std::size_t i = 0; i < 3; ++i) {  // from left to right: the farthest first
    EXPECT_GT(overlap(objects[i].object, cars[2 - i]), 0.8) << i;
    EXPECT_EQ(objects[i].object.id, static_cast<int>(i));
  }
}

TEST(Objects, ACarSeenPastAPersonStaysOne) {
  const auto objects = found({car(13.0, 3.0), person(8.0, 1.7)}, 0.02);
  EXPECT_EQ(objects.size(), 2U);
  EXPECT_EQ(count(objects, ObjectClass::kCar), 1U);
  EXPECT_EQ(count(objects, ObjectClass::kPerson), 1U);
}

TEST(Objects, WhatIsSmallIsAPersonAPoleOrRoadsideByItsSizeAndPlace) {
  const RoadSides road{.left_m = 4.0, .right_m = -4.0};
  const auto type_of = [&](const Block& block) { return found({block}, 0.0, road).at(0).object.type; };
  EXPECT_EQ(type_of(person(10.0, 1.0)), ObjectClass::kPerson);
  EXPECT_EQ(type_of(person(10.0, 5.0)), ObjectClass::kPerson);    // on the sidewalk
  EXPECT_EQ(type_of(person(10.0, 7.0)), ObjectClass::kRoadside);  // beyond it
  const auto pole =
      find_objects(seen({{{8.0, 1.0}, 0.12, 0.12, 0.0}, {{20.0, 0.0}, 0.5, 40.0, 0.0}}), kHeight_m, {});
  EXPECT_EQ(count(pole, ObjectClass::kPole), 1U);
}

TEST(Objects, WhatIsLongRoughOrBeyondTheRoadIsRoadside) {
  const auto wall = found({{{20.0, 6.0}, 20.0, 0.3, 0.0}}, 0.02);
  ASSERT_EQ(wall.size(), 1U);
  EXPECT_EQ(wall[0].object.type, ObjectClass::kRoadside);
  const auto beyond = found({car(12.0, 7.0)}, 0.02, {.left_m = 4.0});
  EXPECT_EQ(beyond.at(0).object.type, ObjectClass::kRoadside);
  EXPECT_EQ(found({car(12.0, 7.0)}, 0.02).at(0).object.type, ObjectClass::kCar);
  std::vector<Block> hedge;  // 3 m of it, across the road, every other twig 25 cm farther back
  for (int i = 0; i < 20; ++i) hedge.push_back({{8.0 + 0.25 * (i % 2), -1.5 + 0.15 * i}, 0.15, 0.15, 0.0});
  const auto rough = found(hedge);
  ASSERT_EQ(rough.size(), 1U);
  EXPECT_EQ(rough[0].object.type, ObjectClass::kRoadside);
}

TEST(Objects, TheirEdgesHoldTheirReturns) {
  const Block block = car(12.0, 4.0);
  const auto points = seen({block}, 0.02);
  const auto objects = find_objects(points, kHeight_m, {});
  ASSERT_EQ(objects.size(), 1U);
  EXPECT_EQ(objects[0].points.size(), points.size());
  EXPECT_LT(distance(objects[0].shape.corner, {9.8, 3.1}), 0.05);
  const auto& edges = objects[0].shape.edges;
  EXPECT_NEAR(std::max(distance(edges[0].begin, edges[0].end), distance(edges[1].begin, edges[1].end)), 4.4,
              0.25);
}

TEST(Objects, MirrorWithTheScan) {
  const std::vector<Block> blocks = {car(9.0, 3.0), car(16.0, -4.0, 15.0), person(7.0, -1.0)};
  std::vector<Block> mirrored = blocks;
  for (Block& block : mirrored)
    block = {{block.center.x, -block.center.y}, block.length_m, block.width_m, -block.yaw_rad};
  const auto plain = found(blocks);
  auto other = found(mirrored);
  ASSERT_EQ(plain.size(), other.size());
  std::ranges::reverse(other);
  for (std::size_t i = 0; i < plain.size(); ++i) {
    EXPECT_EQ(plain[i].object.type, other[i].object.type);
    EXPECT_NEAR(plain[i].object.center.y, -other[i].object.center.y, 0.02);
    EXPECT_NEAR(plain[i].object.size.length_m, other[i].object.size.length_m, 0.02);
    EXPECT_LT(heading_error(plain[i].object, -other[i].object.yaw_rad), deg_to_rad(0.2));
  }
}

TEST(Objects, OfFewPointsAreFew) {
  EXPECT_TRUE(find_objects({}, kHeight_m, {}).empty());
  const std::vector<LayerPoint> one = {{{10.0, 0.0, 0.4}, 0, 0.0, 10.0, 0}};
  EXPECT_TRUE(find_objects(one, kHeight_m, {}).empty());
  std::vector<LayerPoint> low = seen({car(12.0, 4.0)});
  for (LayerPoint& p : low) p.place.z = 0.15;  // the sidewalk's surface
  EXPECT_TRUE(find_objects(low, kHeight_m, {}).empty());
  std::vector<LayerPoint> same(5, one.front());
  EXPECT_TRUE(find_objects(same, kHeight_m, {}).empty());
}

TEST(Objects, StandInTheSensorFrameWhereverItsAxisPoints) {
  const Mount mount{.height_m = 0.5, .pitch_rad = 0.03, .roll_rad = -0.02, .forward_rad = 2.0};
  Object object;
  object.center = {12.0, 3.0, 0.4};
  object.yaw_rad = 1.5;
  const LevelFrame frame(mount);
  const Object in_sensor = to_sensor(object, frame, mount);
  EXPECT_LT(norm(frame.to_level(in_sensor.center) - object.center), 1e-9);
  EXPECT_NEAR(in_sensor.yaw_rad, 3.5 - 2.0 * std::numbers::pi, 1e-12);
}

TEST(Objects, SettingsHaveTheirRanges) {
  EXPECT_NO_THROW(check_fields(ObjectsConfig{}));
  EXPECT_NO_THROW(check_fields(LayerPointsConfig{}));
}

TEST(Completed, IsAsNearToTheUsualSizeAsWhatWasSeenAllows) {
  const auto size_of = [](double seen_m, EdgeEnd below, EdgeEnd above) {
    const Extent whole = completed({0.0, seen_m, below, above}, 4.4);
    return std::array{whole.low_m, whole.high_m};
  };
  const EdgeEnd known{.unseen_m = 0.0};
  const EdgeEnd unknown;
  EXPECT_EQ(size_of(2.0, known, unknown), (std::array{0.0, 4.4}));
  EXPECT_EQ(size_of(2.0, unknown, known), (std::array{2.0 - 4.4, 2.0}));
  EXPECT_EQ(size_of(4.0, known, {.unseen_m = 0.2}), (std::array{0.0, 4.2}));  // it ends there
  EXPECT_EQ(size_of(5.0, unknown, unknown), (std::array{0.0, 5.0}));          // longer than usual
  const auto spread = size_of(4.0, {.unseen_m = 0.3}, {.unseen_m = 0.9});
  EXPECT_NEAR(spread[0], -0.1, 1e-12);
  EXPECT_NEAR(spread[1], 4.3, 1e-12);
}

}  // namespace verge::detect::line_fit
