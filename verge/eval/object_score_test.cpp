// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/eval/object_score.hpp"

#include <cmath>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "verge/eval/box_overlap.hpp"

namespace verge::eval {
namespace {

using ::testing::DoubleNear;
using ::testing::ElementsAre;

constexpr double kPi = std::numbers::pi;

Object box(double x, double y, double length, double width, double yaw = 0.0,
           ObjectClass type = ObjectClass::kCar) {
  Object object;
  object.type = type;
  object.center = {x, y, 0.0};
  object.size = {length, width, 1.5};
  object.yaw_rad = yaw;
  object.confidence = 1.0;
  return object;
}

Scene with(std::vector<Object> objects) {
  Scene scene;
  scene.objects = std::move(objects);
  return scene;
}

TEST(BoxOverlap, ClosedForms) {
  EXPECT_DOUBLE_EQ(intersection_over_union(box(0, 0, 4, 2), box(0, 0, 4, 2)), 1.0);
  EXPECT_DOUBLE_EQ(intersection_over_union(box(0, 0, 4, 2), box(2, 0, 4, 2)), 1.0 / 3.0);
  EXPECT_EQ(intersection_over_union(box(0, 0, 4, 2), box(9, 0, 4, 2)), 0.0);
  // A square and the same one turned by 45 degrees share the regular octagon 2 (sqrt(2) - 1) s^2.
  EXPECT_NEAR(shared_area(box(0, 0, 1, 1), box(0, 0, 1, 1, kPi / 4.0)), 2.0 * (std::sqrt(2.0) - 1.0), 1e-12);
  EXPECT_DOUBLE_EQ(shared_area(box(0, 0, 4, 2), box(0, 0, 4, 2, kPi / 2.0)), 4.0);
  EXPECT_EQ(intersection_over_union(box(0, 0, 0, 0), box(0, 0, 4, 2)), 0.0);
}

bool holds(const Object& object, Vec2 p) {
  const Vec2 d = p - object.center.xy();
  const Vec2 along{std::cos(object.yaw_rad), std::sin(object.yaw_rad)};
  return std::fabs(dot(d, along)) <= 0.5 * object.size.length_m &&
         std::fabs(cross(along, d)) <= 0.5 * object.size.width_m;
}

RC_GTEST_PROP(BoxOverlapLaw, TheSharedAreaIsThatOfTheCellsInBoth, ()) {
  const auto any = [] {
    return box(*rc::gen::inRange(-20, 20) * 0.1, *rc::gen::inRange(-20, 20) * 0.1,
               1.0 + *rc::gen::inRange(0, 30) * 0.1, 1.0 + *rc::gen::inRange(0, 20) * 0.1,
               *rc::gen::inRange(-314, 314) * 0.01);
  };
  const Object a = any();
  const Object b = any();
  constexpr double kCell = 0.05;
  std::size_t cells = 0;
  for (int i = -100; i < 100; ++i) {
    for (int j = -100; j < 100; ++j) {
      const Vec2 p{(i + 0.5) * kCell, (j + 0.5) * kCell};
      cells += holds(a, p) && holds(b, p) ? 1U : 0U;
    }
  }
  RC_ASSERT(std::fabs(shared_area(a, b) - static_cast<double>(cells) * kCell * kCell) < 0.4);
  RC_ASSERT(std::fabs(shared_area(a, b) - shared_area(b, a)) < 1e-9);
}

TEST(ObjectScore, PairsAreMadeOneToOne) {
  const ObjectScore score =
      score_objects(with({box(10, 0, 4, 2, 0.1), box(10.2, 0, 4, 2)}), with({box(10, 0, 4, 2)}), 50.0);
  EXPECT_EQ(score.matched, 1U);
  EXPECT_EQ(*score.precision(), 0.5);
  EXPECT_EQ(*score.recall(), 1.0);
  EXPECT_EQ(score.over_segmented, 1U);  // both lie mostly in the one
}

TEST(ObjectScore, FrontAndBackAreNotToldApart) {
  const ObjectScore score =
      score_objects(with({box(10, 0, 4, 2, kPi - 0.05)}), with({box(10, 0, 4, 2)}), 50.0);
  EXPECT_THAT(score.heading_error_rad, ElementsAre(DoubleNear(0.05, 1e-12)));
  // Each corner moves on a circle of radius sqrt(5) by 0.05 rad.
  EXPECT_THAT(score.corner_error_m, ElementsAre(DoubleNear(2.0 * std::sqrt(5.0) * std::sin(0.025), 1e-12)));
  EXPECT_THAT(score.overlap, ElementsAre(testing::Gt(0.5)));
}

TEST(ObjectScore, OneBoxOverTwoCarsIsUnderSegmented) {
  const ObjectScore score =
      score_objects(with({box(10, 0, 9, 2)}), with({box(7.7, 0, 4, 2), box(12.3, 0, 4, 2)}), 50.0);
  EXPECT_EQ(score.under_segmented, 1U);
  EXPECT_EQ(score.over_segmented, 0U);
  EXPECT_EQ(score.matched, 0U);
}

TEST(ObjectScore, ClassesHaveTheirOwnF1) {
  const ObjectScore score = score_objects(with({box(10, 0, 4, 2), box(20, 0, 4, 2, 0.0, ObjectClass::kVan)}),
                                          with({box(10, 0, 4, 2), box(20, 0, 4, 2)}), 50.0);
  EXPECT_EQ(score.matched, 2U);
  EXPECT_DOUBLE_EQ(*score.class_f1(ObjectClass::kCar), 2.0 / 3.0);
  EXPECT_EQ(*score.class_f1(ObjectClass::kVan), 0.0);
  EXPECT_FALSE(score.class_f1(ObjectClass::kPole).has_value());
}

TEST(ObjectScore, OnlyWithinTheRangeAndScansAddUp) {
  ObjectScore sum = score_objects(with({box(60, 0, 4, 2)}), with({box(60, 0, 4, 2)}), 50.0);
  EXPECT_EQ(sum.truth, 0U);
  sum += score_objects(with({}), with({box(10, 0, 4, 2)}), 50.0);
  sum += score_objects(with({box(10, 0, 4, 2)}), with({box(10, 0, 4, 2)}), 50.0);
  EXPECT_EQ(*sum.recall(), 0.5);
}

// Of a person or a pole a scanner sees a few returns and no box.
TEST(ObjectScore, SmallThingsArePairedByTheirCenters) {
  const auto person = [](double x) { return box(x, 0, 0.5, 0.5, 0.0, ObjectClass::kPerson); };
  const ObjectScore near = score_objects(with({person(10.4)}), with({person(10.0)}), 50.0);
  EXPECT_EQ(*near.class_f1(ObjectClass::kPerson), 1.0);
  EXPECT_TRUE(near.overlap.empty());
  EXPECT_EQ(score_objects(with({person(10.6)}), with({person(10.0)}), 50.0).matched, 0U);
}

TEST(ObjectScore, WhatWasNotSeenOrLiesBeyondTheRangeIsNeitherMissedNorFalse) {
  Object unseen = box(10, 0, 4, 2);
  unseen.confidence = 0.0;
  for (const Object& truth : {unseen, box(20.5, 0, 4, 2)}) {
    ObjectScore score = score_objects(with({box(truth.center.x - 0.6, 0, 4, 2)}), with({truth}), 20.0);
    EXPECT_EQ(score.truth + score.predicted, 0U);
    score += score_objects(with({}), with({truth}), 20.0);
    EXPECT_FALSE(score.recall().has_value());
  }
}

TEST(ObjectScore, CarsOfTwoFacesAreJudgedOnTheirOwn) {
  Object corner = box(10, 0, 4, 2);
  corner.shape = ObjectShape::kL;
  Object rear = box(20, 0, 4, 2);
  rear.shape = ObjectShape::kFace;
  Object missed = box(30, 0, 4, 2);
  missed.shape = ObjectShape::kJ;
  const ObjectScore score =
      score_objects(with({box(11, 0, 4, 2), box(20, 0, 4, 2, 0.1)}), with({corner, rear, missed}), 50.0);
  EXPECT_EQ(score.cars.truth, 3U);
  EXPECT_EQ(score.cars.heading_error_rad.size(), 2U);
  EXPECT_THAT(score.two_faced_cars.overlap, ElementsAre(DoubleNear(3.0 / 5.0, 1e-12)));
  EXPECT_EQ(*score.two_faced_cars.share_above(0.6 - 1e-9), 0.5);  // of the two that are there
  EXPECT_EQ(*score.two_faced_cars.share_above(0.7), 0.0);
}

}  // namespace
}  // namespace verge::eval
