// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/core/pose.hpp"

#include <numbers>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace verge {
namespace {

Pose random_pose() {
  const auto milli = [] { return *rc::gen::inRange(-3000, 3000) * 1e-3; };
  return {from_yaw_pitch_roll(milli(), milli(), milli()), {10.0 * milli(), milli(), milli()}};
}

void expect_near(Vec3 a, Vec3 b, double tolerance) { RC_ASSERT(norm(a - b) < tolerance); }

RC_GTEST_PROP(Pose, InverseUndoes, ()) {
  const Pose T = random_pose();
  const Vec3 p{1.0, -2.0, 3.0};
  expect_near(inverse(T) * (T * p), p, 1e-12);
}

RC_GTEST_PROP(Pose, ProductIsOneAfterTheOther, ()) {
  const Pose a = random_pose();
  const Pose b = random_pose();
  const Vec3 p{-4.0, 0.5, 1.0};
  expect_near((a * b) * p, a * (b * p), 1e-11);
}

RC_GTEST_PROP(Pose, InterpolationMeetsItsEnds, ()) {
  const Pose a = random_pose();
  const Pose b = random_pose();
  const Vec3 p{0.3, 2.0, -1.0};
  expect_near(interpolate(a, b, 0.0) * p, a * p, 1e-9);
  expect_near(interpolate(a, b, 1.0) * p, b * p, 1e-9);
}

TEST(Pose, HalfOfAQuarterTurnIsAnEighth) {
  const Pose quarter{from_yaw_pitch_roll(std::numbers::pi / 2, 0.0, 0.0), {2.0, 0.0, 0.0}};
  const Pose half = interpolate({}, quarter, 0.5);
  EXPECT_NEAR(yaw_of(half.rotation), std::numbers::pi / 4, 1e-12);
  EXPECT_DOUBLE_EQ(half.translation.x, 1.0);
}

TEST(Pose, PositivePitchPointsTheNoseDown) {
  const Vec3 ahead = rotate(from_yaw_pitch_roll(0.0, 0.1, 0.0), {1.0, 0.0, 0.0});
  EXPECT_LT(ahead.z, 0.0);
}

RC_GTEST_PROP(Pose, MatrixRoundTrip, ()) {
  const Pose T = random_pose();
  const Vec3 x = rotate(T.rotation, {1.0, 0.0, 0.0});
  const Vec3 y = rotate(T.rotation, {0.0, 1.0, 0.0});
  const Vec3 z = rotate(T.rotation, {0.0, 0.0, 1.0});
  const Vec3 t = T.translation;
  const auto back = pose_from_matrix({x.x, y.x, z.x, t.x, x.y, y.y, z.y, t.y, x.z, y.z, z.z, t.z});
  RC_ASSERT(back.has_value());
  expect_near(*back * Vec3{1.0, 2.0, 3.0}, T * Vec3{1.0, 2.0, 3.0}, 1e-9);
}

TEST(Pose, AMatrixThatIsNoRotationIsRefused) {
  EXPECT_FALSE(pose_from_matrix({2, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0}).has_value());
  EXPECT_FALSE(pose_from_matrix({1, 0, 0, 0, 0, 1, 0, 0, 0, 0, -1, 0}).has_value());
}

TEST(Interpolate, BetweenEqualPosesItIsThatPoseBitForBit) {
  const Pose pose{from_yaw_pitch_roll(0.3, 0.01, -0.008), {12.5, -3.25, 1.9}};
  for (const double t : {0.0, 0.1, 0.37, 1.0}) EXPECT_EQ(interpolate(pose, pose, t), pose) << t;
}

}  // namespace

}  // namespace verge
