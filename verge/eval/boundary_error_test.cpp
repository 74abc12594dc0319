// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/eval/boundary_error.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace verge::eval {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// A boundary along y = `y`, from x = from to x = to.
Boundary along_x(Side side, double y, double from, double to) {
  Boundary boundary;
  boundary.side = side;
  boundary.points = {{from, y, -1.9}, {to, y, -1.9}};
  return boundary;
}

Scene scene_of(std::string frame, std::vector<Boundary> boundaries) {
  Scene scene;
  scene.frame = std::move(frame);
  scene.boundaries = std::move(boundaries);
  return scene;
}

Scene road(double left, double right) {
  return scene_of("000000",
                  {along_x(Side::kLeft, left, -30.0, 30.0), along_x(Side::kRight, right, -30.0, 30.0)});
}

const BoundaryErrorConfig kConfig{.range_m = 15.0, .tolerance_m = 0.2, .step_m = 0.1};

TEST(Compare, AShiftedLineIsWrongByItsShift) {
  const BoundaryErrors errors = compare(road(4.07, -4.0), road(4.0, -4.0), kConfig);
  const auto wrong = std::count_if(errors.to_truth.begin(), errors.to_truth.end(),
                                   [](double e) { return std::fabs(e - 0.07) < 1e-12; });
  const auto right =
      std::count_if(errors.to_truth.begin(), errors.to_truth.end(), [](double e) { return e < 1e-12; });
  EXPECT_GT(wrong, 200);
  EXPECT_GT(right, 200);
  EXPECT_EQ(static_cast<std::size_t>(wrong + right), errors.to_truth.size());
}

TEST(Compare, TakesTheSamplesWithinTheRange) {
  // |y| = 9 leaves |x| <= 12 of the circle of 15 m: samples from -12 to 12 every 0.1 m.
  const Scene line = scene_of("a", {along_x(Side::kLeft, 9.0, -20.0, 20.0)});
  const BoundaryErrors errors = compare(line, line, kConfig);
  EXPECT_NEAR(static_cast<double>(errors.to_truth.size()), 241.0, 2.0);
  EXPECT_EQ(errors.to_truth.size(), errors.to_prediction.size());
}

TEST(Compare, ALineToTheHorizonIsCutBeforeItIsSampled) {
  const Scene far = scene_of("a", {along_x(Side::kLeft, 9.0, -1e9, 1e9)});
  const Scene near = scene_of("a", {along_x(Side::kLeft, 9.0, -20.0, 20.0)});
  EXPECT_NEAR(static_cast<double>(compare(far, near, kConfig).to_truth.size()), 241.0, 2.0);
}

TEST(Compare, ALineThatLeavesTheRangeAndComesBackIsSampledInBothParts) {
  Boundary out_and_back;
  out_and_back.side = Side::kLeft;
  out_and_back.points = {{0.0, 5.0, 0.0}, {30.0, 5.0, 0.0}, {30.0, 6.0, 0.0}, {0.0, 6.0, 0.0}};
  const Scene scene = scene_of("a", {out_and_back});
  const double expected = 10.0 * (std::sqrt(225.0 - 25.0) + std::sqrt(225.0 - 36.0));
  const BoundaryErrors errors = compare(scene, scene, kConfig);
  EXPECT_NEAR(static_cast<double>(errors.to_truth.size()), expected, 2.0);
  EXPECT_THAT(errors.to_truth, ::testing::Each(::testing::Lt(1e-9)));
}

TEST(Compare, HalfABoundaryIsRightButCoversHalf) {
  const Scene truth = scene_of("a", {along_x(Side::kLeft, 4.0, -10.0, 10.0)});
  const Scene half = scene_of("a", {along_x(Side::kLeft, 4.0, 0.0, 10.0)});
  const BoundarySummary summary = summarise(std::vector{compare(half, truth, kConfig)}, 0.2);
  EXPECT_DOUBLE_EQ(*summary.share_right, 1.0);
  EXPECT_NEAR(*summary.share_covered, (10.0 + 0.2) / 20.0, 0.01);
  EXPECT_NEAR(*summary.percentile_95_m, 0.0, 1e-12);
}

TEST(Compare, LeftIsNotComparedWithRight) {
  const Scene left = scene_of("a", {along_x(Side::kLeft, 4.0, -5.0, 5.0)});
  const Scene right = scene_of("a", {along_x(Side::kRight, 4.0, -5.0, 5.0)});
  const BoundaryErrors errors = compare(left, right, kConfig);
  EXPECT_THAT(errors.to_truth, ::testing::Each(kInfinity));
  EXPECT_THAT(errors.to_prediction, ::testing::Each(kInfinity));
  EXPECT_EQ(*summarise(std::vector{errors}, 0.2).share_right, 0.0);
}

TEST(Compare, WithAnySideThePlaceCountsAndNotTheName) {
  const Scene left = scene_of("a", {along_x(Side::kLeft, 4.0, -5.0, 5.0)});
  const Scene right = scene_of("a", {along_x(Side::kRight, 4.0, -5.0, 5.0)});
  BoundaryErrorConfig config = kConfig;
  config.any_side = true;
  const BoundaryErrors errors = compare(left, right, config);
  EXPECT_THAT(errors.to_truth, ::testing::Each(::testing::Lt(1e-12)));
  EXPECT_THAT(errors.to_prediction, ::testing::Each(::testing::Lt(1e-12)));
}

TEST(Compare, AnUnnamedSideGoesWithAny) {
  const Scene truth = scene_of("a", {along_x(Side::kOther, 4.0, -5.0, 5.0)});
  const Scene left = scene_of("a", {along_x(Side::kLeft, 4.1, -5.0, 5.0)});
  const BoundaryErrors errors = compare(left, truth, kConfig);
  EXPECT_THAT(errors.to_truth, ::testing::Each(::testing::DoubleNear(0.1, 1e-12)));
}

TEST(Compare, HeightDoesNotMatter) {
  Scene high = road(4.0, -4.0);
  for (Vec3& p : high.boundaries[0].points) p.z += 3.0;
  const BoundaryErrors errors = compare(high, road(4.0, -4.0), kConfig);
  EXPECT_THAT(errors.to_truth, ::testing::Each(::testing::Lt(1e-12)));
}

TEST(Compare, ASinglePointIsOneSample) {
  Boundary point;
  point.side = Side::kLeft;
  point.points = {{1.0, 4.5, 0.0}};
  const BoundaryErrors errors = compare(scene_of("a", {point}), road(4.0, -4.0), kConfig);
  EXPECT_THAT(errors.to_truth, ::testing::ElementsAre(::testing::DoubleNear(0.5, 1e-12)));
}

RC_GTEST_PROP(Compare, SwappingPredictionAndTruthSwapsTheDistances, ()) {
  const auto offset = [] { return *rc::gen::inRange(-300, 300) / 100.0; };
  const Scene a = road(4.0 + offset(), -4.0 + offset());
  const Scene b = road(4.0 + offset(), -4.0 + offset());
  const BoundaryErrors forth = compare(a, b, kConfig);
  const BoundaryErrors back = compare(b, a, kConfig);
  RC_ASSERT(forth.to_truth == back.to_prediction);
  RC_ASSERT(forth.to_prediction == back.to_truth);
}

TEST(ShapeOf, ALineIsStraightAndAnArcIsNot) {
  EXPECT_EQ(shape_of(road(4.0, -4.0), 15.0), RoadShape::kStraight);
  Boundary arc;
  for (double t = -0.5; t <= 0.5; t += 0.01) {
    arc.points.push_back({30.0 * std::sin(t), 34.0 - 30.0 * std::cos(t), 0.0});
  }
  EXPECT_EQ(shape_of(scene_of("a", {arc}), 15.0), RoadShape::kCurve);
  EXPECT_EQ(shape_of(scene_of("a", {along_x(Side::kLeft, 4.0, -5.0, 5.0), arc}), 15.0), RoadShape::kCurve);
}

TEST(ShapeOf, ACurveBeyondTheRangeDoesNotCount) {
  Boundary bent = along_x(Side::kLeft, 4.0, -10.0, 10.0);
  bent.points.push_back({40.0, 20.0, 0.0});
  EXPECT_EQ(shape_of(scene_of("a", {bent}), 10.0), RoadShape::kStraight);
  EXPECT_EQ(shape_of(scene_of("a", {bent}), 60.0), RoadShape::kCurve);
}

TEST(ShapeOf, WithoutABoundaryInRangeItIsUnknown) {
  EXPECT_EQ(shape_of(Scene{}, 15.0), RoadShape::kUnknown);
  EXPECT_EQ(shape_of(road(20.0, -20.0), 15.0), RoadShape::kUnknown);
}

TEST(CompareAll, FramesAreMatchedByName) {
  Scene first = road(4.0, -4.0);
  Scene second = road(5.0, -5.0);
  second.frame = "000001";
  const auto comparison = compare_all(std::vector{second, first}, std::vector{first, second}, kConfig);
  ASSERT_TRUE(comparison.has_value());
  ASSERT_EQ(comparison->scans.size(), 2U);
  EXPECT_EQ(comparison->scans[0].frame, "000000");
  EXPECT_EQ(comparison->scans[1].frame, "000001");
  for (const BoundaryErrors& scan : comparison->scans) {
    EXPECT_TRUE(scan.predicted);
    EXPECT_THAT(scan.to_truth, ::testing::Each(::testing::Lt(1e-12)));
  }
}

TEST(CompareAll, ATruthWithoutPredictionIsNotCovered) {
  const auto comparison = compare_all({}, std::vector{road(4.0, -4.0)}, kConfig);
  ASSERT_TRUE(comparison.has_value());
  EXPECT_FALSE(comparison->scans.at(0).predicted);
  const BoundarySummary summary = summarise(comparison->scans, 0.2);
  EXPECT_EQ(summary.scans, 1U);
  EXPECT_EQ(summary.scans_without_prediction, 1U);
  EXPECT_EQ(*summary.share_covered, 0.0);
  EXPECT_FALSE(summary.share_right.has_value());
  EXPECT_FALSE(summary.percentile_95_m.has_value());
}

TEST(CompareAll, APredictionWithoutTruthIsNamedAndLeftOut) {
  Scene stray = road(4.0, -4.0);
  stray.frame = "stray";
  const auto comparison = compare_all(std::vector{stray}, {}, kConfig);
  ASSERT_TRUE(comparison.has_value());
  EXPECT_TRUE(comparison->scans.empty());
  EXPECT_THAT(comparison->frames_without_truth, ::testing::ElementsAre("stray"));
}

TEST(CompareAll, AFrameThatStandsTwiceIsAnError) {
  const std::vector<Scene> twice = {road(4.0, -4.0), road(4.0, -4.0)};
  const auto in_predictions = compare_all(twice, std::vector{road(4.0, -4.0)}, kConfig);
  ASSERT_FALSE(in_predictions.has_value());
  EXPECT_EQ(in_predictions.error().code, ErrorCode::kUnusable);
  EXPECT_EQ(in_predictions.error().got, "000000");
  EXPECT_FALSE(compare_all({}, twice, kConfig).has_value());
}

TEST(CompareAll, RefusesARangeToleranceOrStepThatIsNotPositive) {
  const std::vector<Scene> none;
  for (const BoundaryErrorConfig& config :
       std::vector<BoundaryErrorConfig>{{.range_m = 0.0}, {.tolerance_m = -1.0}, {.step_m = 0.0}}) {
    EXPECT_THROW((void)compare_all(none, none, config), std::invalid_argument);
  }
}

TEST(Summarise, PoolsTheSamplesOfAllScans) {
  BoundaryErrors a;
  BoundaryErrors b;
  for (int i = 1; i <= 60; ++i) a.to_truth.push_back(0.01 * i);
  for (int i = 61; i <= 100; ++i) b.to_truth.push_back(0.01 * i);
  a.to_prediction = {0.1, 0.3};
  b.to_prediction = {0.1, 0.1};
  const BoundarySummary summary = summarise(std::vector{b, a}, 0.2);
  EXPECT_NEAR(*summary.median_m, 0.505, 1e-12);
  EXPECT_NEAR(*summary.percentile_95_m, 0.9505, 1e-12);
  EXPECT_DOUBLE_EQ(*summary.greatest_m, 1.00);
  EXPECT_DOUBLE_EQ(*summary.share_right, 0.20);
  EXPECT_DOUBLE_EQ(*summary.share_covered, 0.75);
  EXPECT_EQ(summary.predicted_samples, 100U);
  EXPECT_EQ(summary.truth_samples, 4U);
}

TEST(Summarise, IsInfiniteOnlyWhereSoManySamplesHaveNoTruth) {
  BoundaryErrors scan;
  for (int i = 0; i < 97; ++i) scan.to_truth.push_back(0.01 * i);
  scan.to_truth.insert(scan.to_truth.begin(), 4, kInfinity);
  const BoundarySummary few = summarise(std::vector{scan}, 0.2);
  EXPECT_DOUBLE_EQ(*few.median_m, 0.50);
  EXPECT_DOUBLE_EQ(*few.percentile_95_m, 0.95);
  EXPECT_EQ(*few.greatest_m, kInfinity);
  scan.to_truth.insert(scan.to_truth.end(), 3, kInfinity);
  EXPECT_EQ(*summarise(std::vector{scan}, 0.2).percentile_95_m, kInfinity);
}

}  // namespace
}  // namespace verge::eval
