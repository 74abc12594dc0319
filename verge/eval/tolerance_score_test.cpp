// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/eval/tolerance_score.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "verge/core/polyline.hpp"
#include "verge/eval/degradation.hpp"
#include "verge/eval/test_scenes.hpp"

namespace verge::eval {
namespace {

using testing::along_x;
using testing::mirrored;
using testing::road;
using testing::scene_of;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

Scene any_road() {
  const auto offset = [] { return *rc::gen::inRange(-60, 60) / 100.0; };
  const auto end = [] { return *rc::gen::inRange(-200, 200) / 10.0 + 0.03; };
  Scene scene = road(4.0 + offset(), -4.0 + offset(), end(), end());
  scene.boundaries.push_back(along_x(Side::kOther, offset(), end(), end()));
  return scene;
}

TEST(MatchBoundaries, ASampleEveryTenthOfAMetreKnowsItsDistance) {
  const SceneMatch match = match_boundaries(scene_of({along_x(Side::kLeft, 4.3, 0.0, 5.0)}),
                                            scene_of({along_x(Side::kLeft, 4.0, -9.0, 9.0)}));
  ASSERT_EQ(match.predicted.size(), 51U);
  for (const MatchedSample& sample : match.predicted) {
    EXPECT_NEAR(sample.distance_m, 0.3, 1e-12);
    EXPECT_NEAR(sample.outward_m, 0.3, 1e-12);
    EXPECT_NEAR(*sample.heading_rad, 0.0, 1e-12);
  }
  EXPECT_EQ(match.truth.size(), 181U);
}

TEST(MatchBoundaries, OutwardIsAwayFromTheRoadOnBothSides) {
  const SceneMatch wide = match_boundaries(road(4.2, -4.2), road(4.0, -4.0));
  for (const MatchedSample& sample : wide.predicted) EXPECT_NEAR(sample.outward_m, 0.2, 1e-12);
  const SceneMatch narrow = match_boundaries(road(3.8, -3.8), road(4.0, -4.0));
  for (const MatchedSample& sample : narrow.predicted) EXPECT_NEAR(sample.outward_m, -0.2, 1e-12);
}

TEST(MatchBoundaries, HeadingIsTheAngleBetweenTheLinesWhicheverWayTheyRun) {
  Boundary tilted;
  tilted.side = Side::kLeft;
  tilted.points = {{10.0, 4.0 + 10.0 * std::tan(0.1), 0.0}, {0.0, 4.0, 0.0}};
  const SceneMatch match =
      match_boundaries(scene_of({tilted}), scene_of({along_x(Side::kLeft, 4.0, 0.0, 20.0)}));
  for (const MatchedSample& sample : match.predicted) EXPECT_NEAR(*sample.heading_rad, 0.1, 1e-12);
}

TEST(MatchBoundaries, WithoutItsSideASampleIsInfinitelyFar) {
  const SceneMatch match = match_boundaries(scene_of({along_x(Side::kLeft, 4.0, 0.0, 1.0)}),
                                            scene_of({along_x(Side::kRight, 4.0, 0.0, 1.0)}));
  EXPECT_EQ(match.predicted.front().distance_m, kInfinity);
  const SceneMatch any =
      match_boundaries(scene_of({along_x(Side::kLeft, 4.0, 0.0, 1.0)}),
                       scene_of({along_x(Side::kRight, 4.0, 0.0, 1.0)}), {.any_side = true});
  EXPECT_EQ(any.predicted.front().distance_m, 0.0);
}

TEST(MatchBoundaries, ASampleHasTheStateOfTheNearerVertex) {
  Boundary half = along_x(Side::kLeft, 4.0, 0.0, 1.0);
  half.state = {PointState::kVisible, PointState::kOccluded};
  const SceneMatch match = match_boundaries(Scene{}, scene_of({half}));
  ASSERT_EQ(match.truth.size(), 11U);
  EXPECT_EQ(std::count_if(match.truth.begin(), match.truth.end(),
                          [](const auto& s) { return s.state == PointState::kVisible; }),
            5);
}

TEST(MatchBoundaries, ALineIsSampledAcrossItsVertices) {
  Boundary line = along_x(Side::kLeft, 4.0, 0.0, 1.0);
  line.points = {{0.0, 4.0, 0.0}, {0.25, 4.0, 0.0}, {0.25, 4.0, 0.0}, {1.0, 4.0, 0.0}};
  const SceneMatch match = match_boundaries(scene_of({line}), Scene{});
  ASSERT_EQ(match.predicted.size(), 11U);
  for (std::size_t i = 0; i < 11; ++i)
    EXPECT_NEAR(match.predicted[i].place.x, 0.1 * static_cast<double>(i), 1e-9);
}

RC_GTEST_PROP(MatchLaw, TheNearestIsTheLeastOfAllDistances, ()) {
  const Scene a = any_road();
  const Scene b = any_road();
  for (const MatchedSample& sample : match_boundaries(a, b, {.any_side = true}).predicted) {
    double least = kInfinity;
    for (const Boundary& boundary : b.boundaries) {
      const std::array line{boundary.points[0].xy(), boundary.points[1].xy()};
      least = std::min(least, distance_to(line, sample.place));
    }
    RC_ASSERT(std::fabs(sample.distance_m - least) < 1e-9);
  }
}

TEST(CountWithin, VisibleAndOccludedTruthAreCountedApart) {
  Scene truth = road(4.0, -4.0, 0.0, 9.0);
  truth.boundaries[1].state = {PointState::kOccluded, PointState::kOccluded};
  const Scene found = scene_of({along_x(Side::kLeft, 4.15, 0.0, 4.5)});
  const ToleranceCounts counts = count_within(match_boundaries(found, truth), 20.0, 0.2);
  EXPECT_EQ(counts.predicted, 46U);
  EXPECT_EQ(counts.right, 46U);
  EXPECT_EQ(counts.visible, 91U);
  EXPECT_EQ(counts.found_visible, 47U);  // to 4.6: 0.1 m beyond the end, 0.18 m away
  EXPECT_EQ(counts.occluded, 91U);
  EXPECT_EQ(counts.found_occluded, 0U);
  EXPECT_EQ(*counts.occluded_recall(), 0.0);
  EXPECT_DOUBLE_EQ(*counts.f1(), 2.0 * (47.0 / 91.0) / (1.0 + 47.0 / 91.0));
}

TEST(CountWithin, OnlyWithinTheRange) {
  const Scene truth = scene_of({along_x(Side::kLeft, 0.0, 0.05, 30.0)});
  EXPECT_EQ(count_within(match_boundaries(truth, truth), 10.0, 0.1).predicted, 100U);
}

TEST(CountWithin, OfNothingThereIsNoShare) {
  const ToleranceCounts none = count_within(match_boundaries(Scene{}, Scene{}), 20.0, 0.2);
  EXPECT_FALSE(none.precision().has_value());
  EXPECT_FALSE(none.f1().has_value());
  EXPECT_EQ(count_within(match_boundaries(Scene{}, road(4.0, -4.0)), 20.0, 0.2).f1(), 0.0);
}

RC_GTEST_PROP(ToleranceLaw, AMirrorChangesNoCount, ()) {
  const Scene a = any_road();
  const Scene b = any_road();
  const auto plain = count_within(match_boundaries(a, b), 15.0, 0.2);
  RC_ASSERT(count_within(match_boundaries(mirrored(a), mirrored(b)), 15.0, 0.2) == plain);
}

RC_GTEST_PROP(ToleranceLaw, TheOrderOfBoundariesChangesNoCount, ()) {
  Scene a = any_road();
  Scene b = any_road();
  const auto plain = count_within(match_boundaries(a, b), 15.0, 0.2);
  std::reverse(a.boundaries.begin(), a.boundaries.end());
  std::reverse(b.boundaries.begin(), b.boundaries.end());
  RC_ASSERT(count_within(match_boundaries(a, b), 15.0, 0.2) == plain);
}

RC_GTEST_PROP(ToleranceLaw, AWiderToleranceFindsNoLess, ()) {
  const SceneMatch match = match_boundaries(any_road(), any_road());
  const auto narrow = count_within(match, 15.0, 0.1);
  const auto wide = count_within(match, 15.0, 0.3);
  RC_ASSERT(narrow.right <= wide.right && narrow.found_visible <= wide.found_visible);
  RC_ASSERT(narrow.predicted == wide.predicted);
}

TEST(ToleranceCells, MicroPoolsSamplesAndMacroAveragesScans) {
  const std::array ranges{20.0};
  const std::array tolerances{0.2};
  const Scene truth = scene_of({along_x(Side::kLeft, 4.0, 0.0, 9.0)});
  const Scene longer = scene_of({along_x(Side::kLeft, 4.0, 0.0, 18.0)});
  std::vector<ToleranceCell> sum;
  add_cells(sum, tolerance_cells(match_boundaries(truth, truth), ranges, tolerances));
  add_cells(sum, tolerance_cells(match_boundaries(Scene{}, longer), ranges, tolerances));
  ASSERT_EQ(sum.size(), 1U);
  EXPECT_DOUBLE_EQ(*sum[0].counts.recall(), 91.0 / 272.0);
  EXPECT_DOUBLE_EQ(*sum[0].macro_f1(), 0.5);
}

RangeBins bins_of(std::vector<std::array<std::size_t, 4>> rows) {
  RangeBins bins;
  for (const auto& [predicted, right, visible, found] : rows)
    bins.bins.push_back({predicted, right, visible, found, 0, 0});
  return bins;
}

TEST(DetectionRange, EndsBeforeTheFirstBinThatFails) {
  EXPECT_EQ(detection_range_m(bins_of({{10, 10, 10, 10}, {10, 9, 10, 9}, {10, 8, 10, 10}, {10, 10, 10, 10}})),
            10.0);
  EXPECT_EQ(detection_range_m(bins_of({{10, 10, 10, 10}, {10, 10, 10, 8}})), 5.0);
  EXPECT_EQ(detection_range_m(bins_of({{10, 0, 10, 10}})), 0.0);
}

TEST(DetectionRange, ABinWithoutAnythingIsPassedOver) {
  EXPECT_EQ(detection_range_m(bins_of({{0, 0, 0, 0}, {10, 10, 10, 10}, {0, 0, 0, 0}})), 10.0);
  EXPECT_FALSE(detection_range_m(bins_of({{0, 0, 0, 0}})).has_value());
  EXPECT_FALSE(detection_range_m(RangeBins{}).has_value());
}

TEST(CountByRange, BinsAddUpToTheWhole) {
  const SceneMatch match = match_boundaries(road(4.1, -4.3), road(4.0, -4.0));
  ToleranceCounts sum;
  for (const ToleranceCounts& bin : count_by_range(match, 5.0, 0.2).bins) sum += bin;
  EXPECT_EQ(sum, count_within(match, 1e3, 0.2));
}

TEST(CountByConfidence, UnsureBoundariesGoFirst) {
  Scene found = road(4.0, -6.0, 0.0, 9.0);
  found.boundaries[0].confidence = 0.8;
  found.boundaries[1].confidence = 0.3;
  const auto points = count_by_confidence(found, road(4.0, -4.0, 0.0, 9.0), {}, 20.0, 0.2);
  ASSERT_EQ(points.size(), 21U);
  EXPECT_EQ(*points[6].counts.precision(), 0.5);  // 0.3
  EXPECT_EQ(*points[7].counts.precision(), 1.0);
  EXPECT_FALSE(points[17].counts.precision().has_value());
  EXPECT_EQ(*points[16].counts.recall(), 0.5);
}

TEST(DegradationCurve, StandsInOrderOfTheConditionAndSaysTheLoss) {
  DegradationCurve curve("range noise", "m");
  curve.add(0.05, {100, 50, 100, 50, 0, 0});
  curve.add(0.01, {50, 50, 50, 50, 0, 0});
  DegradationCurve more("range noise", "m");
  more.add(0.01, {50, 50, 50, 50, 0, 0});
  curve += more;
  const auto points = curve.points();
  ASSERT_EQ(points.size(), 2U);
  EXPECT_EQ(points[0].value, 0.01);
  EXPECT_EQ(points[0].counts.predicted, 100U);
  EXPECT_EQ(points[0].f1_loss, 0.0);
  EXPECT_DOUBLE_EQ(*points[1].f1_loss, 0.5);
}

}  // namespace
}  // namespace verge::eval
