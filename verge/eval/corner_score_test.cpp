// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/eval/corner_score.hpp"

#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "verge/eval/junction_score.hpp"

namespace verge::eval {
namespace {

using ::testing::DoubleNear;
using ::testing::ElementsAre;

Corner corner(int id, CornerSide side, double x, double y, double confidence = 1.0) {
  return {.id = id, .side = side, .position = {x, y}, .confidence = confidence};
}

Scene with_corners(std::vector<Corner> corners) {
  Scene scene;
  scene.corners = std::move(corners);
  return scene;
}

/// Scenes of a drive, prediction and truth by turns.
CornerScore score_of(const std::vector<std::pair<Scene, Scene>>& drive) {
  std::vector<CornerFrame> frames;
  for (const auto& [prediction, truth] : drive) frames.push_back({&prediction, &truth});
  return score_corners(frames);
}

/// A corner that comes 2 m nearer with every scan.
Scene approach(int scan) { return with_corners({corner(1, CornerSide::kRight, 20.0 - 2.0 * scan, -3.0)}); }

TEST(CornerScore, ADetectionBetweenFirstSightAndExitCounts) {
  const Scene near = with_corners({corner(9, CornerSide::kRight, 15.0, -3.0)});  // 1 m off in scan 2
  const CornerScore score = score_of({{Scene{}, approach(0)}, {Scene{}, approach(1)}, {near, approach(2)}});
  EXPECT_EQ(score.true_corners, 1U);
  EXPECT_EQ(score.detected, 1U);
  EXPECT_EQ(*score.m1(), 1.0);
  EXPECT_THAT(score.latency_scans, ElementsAre(2.0));
  EXPECT_THAT(score.position_error_m, ElementsAre(DoubleNear(1.0, 1e-12)));
  EXPECT_THAT(score.latency_m,
              ElementsAre(DoubleNear(norm(Vec2{20.0, -3.0}) - norm(Vec2{16.0, -3.0}), 1e-12)));
  EXPECT_EQ(score.reports, 1U);
  EXPECT_EQ(score.false_reports, 0U);
}

TEST(CornerScore, ADetectionBehindTheEntranceIsLate) {
  for (const double distance_m : {0.5, -0.5}) {
    Corner passed = corner(1, CornerSide::kRight, distance_m, -3.0);
    passed.distance_m = distance_m;
    const Scene scene = with_corners({passed});
    const CornerScore score = score_of({{scene, scene}, {scene, scene}});
    EXPECT_EQ(score.detected, 1U);
    EXPECT_EQ(score.late, distance_m < 0.0 ? 1U : 0U);
    EXPECT_THAT(score.ahead_m, ElementsAre(distance_m));
  }
}

TEST(CornerScore, FartherThanTwoMetresOrOnTheOtherSideIsFalse) {
  const CornerScore far =
      score_of({{with_corners({corner(9, CornerSide::kRight, 17.9, -3.0)}), approach(0)}});
  EXPECT_EQ(far.detected, 0U);
  EXPECT_EQ(far.false_reports, 1U);
  EXPECT_EQ(*far.false_discovery_rate(), 1.0);
  const CornerScore left =
      score_of({{with_corners({corner(9, CornerSide::kLeft, 20.0, -3.0)}), approach(0)}});
  EXPECT_EQ(left.detected, 0U);
  const CornerScore both =
      score_of({{with_corners({corner(9, CornerSide::kBoth, 20.0, -3.0)}), approach(0)}});
  EXPECT_EQ(both.detected, 1U);
}

TEST(CornerScore, AFalseCornerThatIsReportedCountsForM2AndAsAFalseReport) {
  const Scene truth = with_corners(
      {corner(1, CornerSide::kLeft, 10.0, 4.0, 0.0), corner(2, CornerSide::kRight, 10.0, -4.0, 0.0)});
  const CornerScore score = score_of({{with_corners({corner(5, CornerSide::kLeft, 10.5, 4.0)}), truth}});
  EXPECT_EQ(score.true_corners, 0U);
  EXPECT_FALSE(score.m1().has_value());
  EXPECT_EQ(*score.m2(), 0.5);
  EXPECT_EQ(*score.false_discovery_rate(), 1.0);
  EXPECT_TRUE(score.latency_scans.empty());
}

TEST(CornerScore, AnIdIsOneReportUntilItIsGoneForAScan) {
  const Scene report = with_corners({corner(3, CornerSide::kLeft, 5.0, 9.0)});
  const CornerScore score =
      score_of({{report, Scene{}}, {report, Scene{}}, {Scene{}, Scene{}}, {report, Scene{}}});
  EXPECT_EQ(score.reports, 2U);
  EXPECT_EQ(score.false_reports, 2U);
}

TEST(CornerScore, DrivesAddUp) {
  CornerScore sum = score_of({{Scene{}, approach(0)}});
  sum += score_of({{approach(0), approach(0)}});
  EXPECT_EQ(*sum.m1(), 0.5);
  EXPECT_THAT(sum.position_error_m, ElementsAre(0.0));
}

// ---- Junctions

Scene with_junction(JunctionType type, Vec2 center, std::vector<double> branches = {}) {
  Scene scene;
  scene.junctions.push_back({type, center, std::move(branches), 1.0});
  return scene;
}

TEST(CornerScore, FalseReportsAreCountedAKilometreOfTheWay) {
  Scene alarm;
  alarm.corners = {{.id = 1, .position = {50.0, 0.0}, .confidence = 1.0}};
  const Scene truth;
  std::vector<CornerFrame> drive = {{&alarm, &truth, Vec2{0.0, 0.0}}, {&truth, &truth, Vec2{30.0, 40.0}}};
  EXPECT_DOUBLE_EQ(score_corners(drive).way_m, 50.0);
  EXPECT_DOUBLE_EQ(*score_corners(drive).false_reports_a_km(), 20.0);
  drive[1].place.reset();
  EXPECT_FALSE(score_corners(drive).false_reports_a_km().has_value());
}

TEST(JunctionScore, TypesBranchesAndCentersAreCompared) {
  const double pi = std::numbers::pi;
  const JunctionScore score =
      score_junction(with_junction(JunctionType::kT, {21.0, 0.0}, {pi - 0.1, 1.5, -1.6}),
                     with_junction(JunctionType::kT, {20.0, 0.0}, {-pi + 0.1, -1.5, 1.5}));
  EXPECT_EQ(*score.type_accuracy(), 1.0);
  EXPECT_EQ(*score.branch_count_accuracy(), 1.0);
  EXPECT_THAT(score.branch_error_rad,
              ElementsAre(DoubleNear(0.0, 1e-12), DoubleNear(0.1, 1e-12), DoubleNear(0.2, 1e-12)));
  EXPECT_THAT(score.center_error_m, ElementsAre(DoubleNear(1.0, 1e-12)));
  EXPECT_EQ(*score.detection_distance_m(), 25.0);
}

TEST(JunctionScore, MacroF1IsTheMeanOverTypesThatOccur) {
  JunctionScore sum;
  sum += score_junction(with_junction(JunctionType::kT, {8.0, 0.0}),
                        with_junction(JunctionType::kT, {8.0, 0.0}));
  sum += score_junction(with_junction(JunctionType::kT, {8.0, 0.0}),
                        with_junction(JunctionType::kCrossing, {8.0, 0.0}));
  sum += score_junction(Scene{}, Scene{});
  EXPECT_DOUBLE_EQ(*sum.type_accuracy(), 2.0 / 3.0);
  // T: 1 right, 1 false: 2/3; crossing: 1 missed: 0; none: 1.
  EXPECT_DOUBLE_EQ(*sum.macro_f1(), (2.0 / 3.0 + 0.0 + 1.0) / 3.0);
}

TEST(JunctionScore, DetectionDistanceEndsWhereTypesGoWrong) {
  JunctionScore sum;
  for (const double x : {3.0, 13.0, 33.0}) {
    const Scene truth = with_junction(JunctionType::kLeft, {x, 0.0});
    sum += score_junction(x < 20.0 ? truth : Scene{}, truth);
  }
  EXPECT_EQ(*sum.detection_distance_m(), 15.0);
  EXPECT_FALSE(score_junction(Scene{}, Scene{}).detection_distance_m().has_value());
}

TEST(JunctionScore, AJunctionThatIsNoneIsAFalseOne) {
  const JunctionScore score = score_junction(with_junction(JunctionType::kLeft, {9.0, 0.0}), Scene{});
  EXPECT_EQ(*score.type_accuracy(), 0.0);
  EXPECT_EQ(score.confusion.at(JunctionScore::kNone).at(static_cast<std::size_t>(JunctionType::kLeft)), 1U);
}

}  // namespace
}  // namespace verge::eval
