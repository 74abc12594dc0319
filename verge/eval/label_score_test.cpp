// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/eval/label_score.hpp"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "verge/eval/label_success.hpp"
#include "verge/eval/test_scenes.hpp"

namespace verge::eval {
namespace {

using testing::along_x;
using testing::scene_of;

const LabelScoreConfig kConfig{.range_m = 20.0, .tolerance_m = {0.1, 0.3}};

/// Kerb points along y = 4, every metre from x = 0 to x = 9, the first five of them 0.1 m high; ground all
/// around.
LabelledTruth kerb() {
  LabelledTruth truth;
  for (int i = 0; i < 10; ++i) {
    truth.points.push_back({{1.0 * i, 4.0}, i < 5 ? 0.1 : 0.01});
    if (i > 0) truth.segments.push_back({{1.0 * i - 1.0, 4.0}, {1.0 * i, 4.0}});
  }
  truth.ground.emplace();
  for (double x = -19.0; x < 19.0; x += 0.5) {
    for (double y = -19.0; y < 19.0; y += 0.5) truth.ground->push_back({x, y});
  }
  return truth;
}

/// Every 0.1 m of the line, as the definition says it, without leaving anything out.
std::vector<Vec2> all_stations(const std::vector<Vec2>& line, double step) {
  std::vector<double> at{0.0};
  for (std::size_t i = 1; i < line.size(); ++i)
    at.push_back(at.back() + std::hypot(line[i].x - line[i - 1].x, line[i].y - line[i - 1].y));
  std::vector<Vec2> out;
  for (double k = 0; k < std::ceil((at.back() + step / 2.0) / step); ++k) {
    const double s = k * step;
    std::size_t i = 1;
    while (i < line.size() && at[i] <= s) ++i;
    if (i == line.size()) {
      out.push_back(line.back());
      continue;
    }
    const double t = (s - at[i - 1]) / (at[i] - at[i - 1]);
    out.push_back(line[i - 1] + t * (line[i] - line[i - 1]));
  }
  return out;
}

RC_GTEST_PROP(SamplesWithin, AreTheStationsOfTheWholeLineThatLieInReach, ()) {
  constexpr double kReach = 10.0137;  // no sample is as far as that to the last digit
  std::vector<Vec2> line;
  for (int i = *rc::gen::inRange(2, 6); i > 0; --i)
    line.push_back({*rc::gen::inRange(-300, 300) * 0.1, *rc::gen::inRange(-300, 300) * 0.1});
  std::vector<Vec2> expected = all_stations(line, 0.1);
  std::erase_if(expected, [](Vec2 p) { return std::hypot(p.x, p.y) >= kReach; });
  const std::vector<Vec2> samples = samples_within(line, 0.1, kReach);
  RC_ASSERT(samples.size() == expected.size());
  for (std::size_t i = 0; i < samples.size(); ++i) RC_ASSERT(distance(samples[i], expected[i]) < 1e-9);
}

TEST(SamplesWithin, ALineToTheHorizonCostsNoMoreThanItsPartInReach) {
  EXPECT_NEAR(
      static_cast<double>(samples_within(std::vector<Vec2>{{-1e8, 0.0}, {1e8, 0.0}}, 0.1, 10.0).size()),
      200.0, 1.0);
  EXPECT_TRUE(samples_within(std::vector<Vec2>{{-1e300, 0.0}, {1e300, 0.0}}, 0.1, 10.0).empty());
  EXPECT_EQ(samples_within(std::vector<Vec2>{{1.0, 1.0}, {1.0, 1.0}}, 0.1, 10.0).size(), 1U);
  EXPECT_EQ(samples_within(std::vector<Vec2>{{1.0, 1.0}}, 0.1, 10.0).size(), 1U);
  EXPECT_TRUE(samples_within({}, 0.1, 10.0).empty());
}

TEST(LabelScore, AShiftedLineIsRightAtTheTolerancesAboveItsShift) {
  const Scene found = scene_of({along_x(Side::kLeft, 4.2, 0.0, 9.0)});
  const LabelScore s = score(kerb(), &found, kConfig);
  EXPECT_EQ(s.true_points, 10U);
  EXPECT_EQ(s.kerb_points, 5U);
  EXPECT_EQ(s.samples, 91U);
  EXPECT_EQ(s.at[0].found, 0U);
  EXPECT_EQ(s.at[0].right, 0U);
  EXPECT_EQ(s.at[1].found, 10U);
  EXPECT_EQ(s.at[1].found_kerbs, 5U);
  EXPECT_EQ(s.at[1].right, 91U);
  const LabelFigures figures = figures_of(s, s.at[1]);
  EXPECT_NEAR(figures.rmse_m, 0.2, 1e-12);
  EXPECT_EQ(figures.f1, 1.0);
  EXPECT_EQ(figures.judged, 1.0);
}

TEST(LabelScore, HalfALineHasHalfTheRecall) {
  const Scene found = scene_of({along_x(Side::kOther, 4.0, 0.0, 4.5)});
  const LabelScore s = score(kerb(), &found, kConfig);
  EXPECT_EQ(s.at[0].found, 5U);
  EXPECT_DOUBLE_EQ(figures_of(s, s.at[0]).f1, 2.0 * 0.5 / 1.5);
  EXPECT_EQ(*figures_of(s, s.at[0]).kerb_recall, 1.0);
}

TEST(LabelScore, WhereNoGroundIsLabelledNothingIsWrong) {
  LabelledTruth truth = kerb();
  std::erase_if(*truth.ground, [](Vec2 p) { return p.y < 0.0; });
  const Scene found = scene_of({along_x(Side::kRight, -8.0, 0.0, 9.0)});
  const LabelScore s = score(truth, &found, kConfig);
  EXPECT_EQ(s.samples, 91U);
  EXPECT_EQ(s.at[0].judged, 0U);
}

TEST(LabelScore, OnAHiddenStretchASampleIsRightOrNotJudged) {
  LabelledTruth truth = kerb();
  truth.hidden = {{{0.0, -6.0}, {9.0, -6.0}}, {{0.0, 4.0}, {9.0, 4.0}}};
  const Scene found = scene_of({along_x(Side::kRight, -6.2, 0.0, 9.0), along_x(Side::kLeft, 4.0, 0.0, 9.0)});
  const LabelScore s = score(truth, &found, kConfig);
  EXPECT_EQ(s.samples, 182U);
  EXPECT_EQ(s.at[0].judged, 91U);
  EXPECT_EQ(s.at[0].right, 91U);
}

TEST(LabelScore, WhereLabelsCoverAPartSamplesFarFromThemAreNotJudged) {
  LabelledTruth truth = kerb();
  truth.ground.reset();
  const Scene found = scene_of({along_x(Side::kRight, -6.0, 0.0, 9.0), along_x(Side::kLeft, 5.0, 0.0, 9.0)});
  const LabelScore s = score(truth, &found, kConfig);
  EXPECT_EQ(s.at[0].judged, 91U);
  EXPECT_EQ(s.at[0].right, 0U);
  EXPECT_EQ(s.kerb_points, 0U);
  EXPECT_FALSE(figures_of(s, s.at[0]).kerb_recall.has_value());
}

TEST(LabelScore, WithoutAPredictionAScanIsAbsent) {
  const LabelScore s = score(kerb(), nullptr, kConfig);
  EXPECT_EQ(s.absent, 1U);
  EXPECT_EQ(s.true_points, 10U);
  EXPECT_EQ(figures_of(s, s.at[0]).f1, 0.0);
  EXPECT_EQ(score(kerb(), nullptr, kConfig).at[0].judged, 0U);
}

TEST(LabelScore, ScansAddUp) {
  const Scene whole = scene_of({along_x(Side::kLeft, 4.0, 0.0, 9.0)});
  const Scene half = scene_of({along_x(Side::kLeft, 4.0, 0.0, 4.5)});
  LabelScore sum;
  sum += score(kerb(), &whole, kConfig);
  sum += score(kerb(), &half, kConfig);
  EXPECT_EQ(sum.scans, 2U);
  EXPECT_EQ(sum.at[0].found, 15U);
  EXPECT_DOUBLE_EQ(figures_of(sum, sum.at[0]).recall, 0.75);
  EXPECT_DOUBLE_EQ(figures_of(sum, sum.at[0]).macro_f1, (1.0 + 2.0 / 3.0) / 2.0);
}

RC_GTEST_PROP(LabelScoreLaw, TheOrderOfBoundariesAndOfTruePointsDoesNotMatter, ()) {
  std::vector<Boundary> boundaries;
  for (int i = *rc::gen::inRange(1, 5); i > 0; --i)
    boundaries.push_back(along_x(Side::kLeft, 4.0 + 0.1 * *rc::gen::inRange(-6, 6), 0.0, 1.0 * i));
  LabelledTruth truth = kerb();
  const Scene found = scene_of(boundaries);
  const LabelScore before = score(truth, &found, kConfig);
  std::reverse(boundaries.begin(), boundaries.end());
  std::reverse(truth.points.begin(), truth.points.end());
  std::reverse(truth.segments.begin(), truth.segments.end());
  const Scene reversed = scene_of(boundaries);
  const LabelScore after = score(truth, &reversed, kConfig);
  for (std::size_t i = 0; i < before.at.size(); ++i) {
    RC_ASSERT(before.at[i].found == after.at[i].found);
    RC_ASSERT(before.at[i].judged == after.at[i].judged);
    RC_ASSERT(before.at[i].right == after.at[i].right);
  }
}

// --- Success of scans
// ------------------------------------------------------------------------------------------------

std::optional<Deviation> deviation_of_line(double y, double last_x) {
  const Scene scene = scene_of({along_x(Side::kLeft, y, 0.0, last_x)});
  return deviation_of(kerb(), &scene);
}

TEST(LabelSuccess, NeedsNineTenthsOfTheTruthAndNothingFarOff) {
  EXPECT_EQ(deviation_of_line(4.1, 9.0), Deviation::kMinimum);
  EXPECT_EQ(deviation_of_line(4.1, 8.0), Deviation::kMinimum);  // 9 of 10 points
  EXPECT_EQ(deviation_of_line(4.1, 7.0), Deviation::kFailed);
  EXPECT_EQ(deviation_of_line(4.4, 9.0), Deviation::kLarger);
  EXPECT_EQ(deviation_of_line(4.6, 9.0), Deviation::kFailed);
}

TEST(LabelSuccess, AStrayLineFailsAScanThatFoundAll) {
  Scene scene = scene_of({along_x(Side::kLeft, 4.1, 0.0, 9.0), along_x(Side::kLeft, 4.7, 0.0, 3.0)});
  EXPECT_EQ(deviation_of(kerb(), &scene), Deviation::kLarger);
  scene = scene_of({along_x(Side::kLeft, 4.1, 0.0, 9.0), along_x(Side::kLeft, 6.0, 0.0, 3.0)});
  EXPECT_EQ(deviation_of(kerb(), &scene), Deviation::kFailed);
}

TEST(LabelSuccess, OfLabelledPointsAloneWhatIsFoundTooMuchIsNotCounted) {
  LabelledTruth points = kerb();
  points.ground.reset();
  const Scene scene = scene_of({along_x(Side::kLeft, 4.1, 0.0, 9.0), along_x(Side::kLeft, 5.5, 0.0, 3.0)});
  EXPECT_EQ(deviation_of(points, &scene), Deviation::kMinimum);
  EXPECT_EQ(deviation_of(kerb(), &scene), Deviation::kFailed);
}

TEST(LabelSuccess, WithoutAPredictionFailsAndWithoutTruthIsNone) {
  EXPECT_EQ(deviation_of(kerb(), nullptr), Deviation::kFailed);
  EXPECT_EQ(deviation_of(LabelledTruth{}, nullptr), std::nullopt);
}

}  // namespace
}  // namespace verge::eval
