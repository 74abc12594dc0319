// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/io/file/transforms.hpp"

#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace verge::io {
namespace {

constexpr std::int64_t kSecond = 1'000'000'000;

Pose at_x(double x) { return {{}, {x, 0.0, 0.0}}; }
Pose turned(double yaw) { return {from_yaw_pitch_roll(yaw, 0.0, 0.0), {}}; }

StampedTransform placed(std::int64_t stamp_ns, std::string parent, std::string child, Pose pose) {
  return {stamp_ns, std::move(parent), std::move(child), pose};
}

}  // namespace

TEST(Transforms, BetweenTwoPosesItIsInterpolated) {
  Transforms tree;
  EXPECT_TRUE(tree.add(placed(0, "odom", "car", at_x(1.0)), TransformOrigin::kTree));
  EXPECT_TRUE(tree.add(placed(kSecond / 10, "odom", "car", at_x(2.0)), TransformOrigin::kTree));
  const auto pose = tree.T_world_frame("car", kSecond / 40);
  ASSERT_TRUE(pose);
  EXPECT_DOUBLE_EQ(pose->translation.x, 1.25);
  EXPECT_EQ(tree.T_world_frame("car", 0)->translation.x, 1.0);             // the pose itself
  EXPECT_EQ(tree.T_world_frame("car", kSecond / 10)->translation.x, 2.0);  // and the last
}

TEST(Transforms, OutsideOfItsPosesThereIsNone) {
  Transforms tree;
  EXPECT_FALSE(tree.T_world_frame("car", 0));
  EXPECT_TRUE(tree.add(placed(kSecond, "odom", "car", at_x(1.0)), TransformOrigin::kTree));
  EXPECT_FALSE(tree.T_world_frame("car", kSecond - 1));
  EXPECT_TRUE(tree.T_world_frame("car", kSecond));
  EXPECT_FALSE(tree.T_world_frame("car", kSecond + 1));
  EXPECT_TRUE(tree.add(placed(3 * kSecond, "odom", "car", at_x(3.0)), TransformOrigin::kTree));
  EXPECT_FALSE(tree.T_world_frame("car", 2 * kSecond));  // a gap of 2 s says nothing
}

TEST(Transforms, AChainOfFramesIsMultipliedUpToTheWorld) {
  constexpr double kPi = std::numbers::pi;
  Transforms tree;
  // The car stands at (5, 0), turned to the left; the sensor is 1 m ahead of it: at (5, 1).
  EXPECT_TRUE(tree.add(placed(0, "base", "lidar", at_x(1.0)), TransformOrigin::kStatic));
  EXPECT_TRUE(tree.add(placed(0, "odom", "base", turned(kPi / 2)), TransformOrigin::kTree));
  EXPECT_TRUE(tree.add(placed(kSecond / 2, "odom", "base", turned(kPi / 2)), TransformOrigin::kTree));
  EXPECT_TRUE(tree.add(placed(-kSecond, "map", "odom", at_x(5.0)), TransformOrigin::kStatic));
  const auto pose = tree.T_world_frame("lidar", kSecond / 4);
  ASSERT_TRUE(pose);
  EXPECT_NEAR(pose->translation.x, 5.0, 1e-12);
  EXPECT_NEAR(pose->translation.y, 1.0, 1e-12);
  EXPECT_NEAR(yaw_of(pose->rotation), kPi / 2, 1e-12);
}

TEST(Transforms, StaticFramesAloneAreNoWorld) {
  Transforms tree;
  EXPECT_TRUE(tree.add(placed(0, "base", "lidar", at_x(1.0)), TransformOrigin::kStatic));
  EXPECT_FALSE(tree.T_world_frame("lidar", 0));
}

TEST(Transforms, TheTreeWinsOverOdometry) {
  Transforms tree;
  EXPECT_TRUE(tree.add(placed(0, "odom", "base", at_x(1.0)), TransformOrigin::kOdometry));
  EXPECT_EQ(tree.T_world_frame("base", 0)->translation.x, 1.0);
  EXPECT_TRUE(tree.add(placed(0, "odom", "base", at_x(2.0)), TransformOrigin::kTree));
  EXPECT_FALSE(tree.add(placed(0, "odom", "base", at_x(3.0)), TransformOrigin::kOdometry));
  EXPECT_EQ(tree.T_world_frame("base", 0)->translation.x, 2.0);
}

TEST(Transforms, WhatIsNoPoseIsRefused) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  Transforms tree;
  EXPECT_FALSE(tree.add(placed(0, "odom", "base", at_x(nan)), TransformOrigin::kTree));
  EXPECT_FALSE(tree.add(placed(0, "odom", "base", {{nan, 0, 0, 0}, {}}), TransformOrigin::kTree));
  EXPECT_FALSE(tree.add(placed(0, "odom", "base", {{0, 0, 0, 0}, {}}), TransformOrigin::kTree));
  EXPECT_FALSE(tree.add(placed(0, "odom", "base", {{2, 0, 0, 0}, {}}), TransformOrigin::kTree));
  EXPECT_FALSE(tree.add(placed(0, "odom", "odom", {}), TransformOrigin::kTree));
  EXPECT_FALSE(tree.add(placed(0, "", "odom", {}), TransformOrigin::kTree));
  EXPECT_FALSE(tree.add(placed(0, "odom", "", {}), TransformOrigin::kTree));
}

TEST(Transforms, FramesThatStandInEachOtherHaveNoWorld) {
  Transforms tree;
  EXPECT_TRUE(tree.add(placed(0, "a", "b", {}), TransformOrigin::kTree));
  EXPECT_TRUE(tree.add(placed(0, "b", "a", {}), TransformOrigin::kTree));
  EXPECT_FALSE(tree.T_world_frame("a", 0));
}

TEST(Transforms, OnlyTheLastSecondsAndSoManyFramesAreKept) {
  Transforms tree;
  for (int i = 0; i <= 200; ++i)
    EXPECT_TRUE(tree.add(placed(i * kSecond / 10, "odom", "base", at_x(i)), TransformOrigin::kTree));
  EXPECT_TRUE(tree.T_world_frame("base", 10 * kSecond));
  EXPECT_FALSE(tree.T_world_frame("base", 10 * kSecond - 1));
  for (int i = 0; i < 255; ++i)
    EXPECT_TRUE(tree.add(placed(0, "odom", "f" + std::to_string(i), {}), TransformOrigin::kTree));
  EXPECT_FALSE(tree.add(placed(0, "odom", "one too many", {}), TransformOrigin::kTree));
}

TEST(Transforms, AJumpInTimeBeginsAnew) {
  Transforms tree;
  EXPECT_TRUE(tree.add(placed(100 * kSecond, "odom", "base", at_x(1.0)), TransformOrigin::kTree));
  EXPECT_TRUE(tree.add(placed(5 * kSecond, "odom", "base", at_x(2.0)), TransformOrigin::kTree));
  EXPECT_FALSE(tree.T_world_frame("base", 100 * kSecond));
  EXPECT_EQ(tree.T_world_frame("base", 5 * kSecond)->translation.x, 2.0);
  constexpr auto kFirst = std::numeric_limits<std::int64_t>::min();
  EXPECT_TRUE(tree.add(placed(kFirst, "odom", "base", at_x(3.0)), TransformOrigin::kTree));
  EXPECT_EQ(tree.T_world_frame("base", kFirst)->translation.x, 3.0);
}

RC_GTEST_PROP(Transforms, TheOrderOfThePosesDoesNotMatter, ()) {
  // Poses on a line, x = t: whatever was added and in which order, between two of them it is x = t.
  auto times = *rc::gen::container<std::vector<int>>(rc::gen::inRange(0, 1000));
  Transforms tree;
  for (const int t : times)
    RC_ASSERT(tree.add(placed(t * 1'000'000LL, "odom", "base", at_x(t)), TransformOrigin::kTree));
  const int t = *rc::gen::inRange(0, 1000);
  const auto pose = tree.T_world_frame("base", t * 1'000'000LL);
  const bool before = std::any_of(times.begin(), times.end(), [&](int other) { return other <= t; });
  const bool after = std::any_of(times.begin(), times.end(), [&](int other) { return other >= t; });
  RC_ASSERT(pose.has_value() == (before && after));
  if (pose) RC_ASSERT(std::fabs(pose->translation.x - t) < 1e-9);
}

}  // namespace verge::io
