// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/fit/theil_sen.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <span>
#include <vector>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "verge/core/statistics.hpp"
#include "verge/fit/pair_slopes.hpp"
#include "verge/fit/test_points.hpp"

namespace verge::fit {
namespace {

double slope_of(const Line& line) { return line.direction.y / line.direction.x; }

/// The example of the intervals: 60 points every 0.5 m from 0 to 29.5 m on y = 1 + 0.2 x, 0.15 m of noise.
std::vector<Vec2> example(std::uint32_t seed) {
  std::mt19937 engine(seed);
  std::normal_distribution<double> noise(0.0, 0.15);
  std::vector<Vec2> points;
  for (int i = 0; i < 60; ++i) points.push_back({0.5 * i, 1.0 + 0.1 * i + noise(engine)});
  return points;
}

/// All slopes, sorted, by definition.
std::vector<double> sorted_slopes(const std::vector<Vec2>& points, double min_step_m) {
  std::vector<double> slopes;
  for (const Vec2 a : points) {
    for (const Vec2 b : points) {
      if (b.x - a.x >= min_step_m) slopes.push_back((b.y - a.y) / (b.x - a.x));
    }
  }
  std::ranges::sort(slopes);
  return slopes;
}

double deviation(const std::vector<double>& values) {
  const double middle = mean(values).value();
  double squares = 0.0;
  for (const double v : values) squares += (v - middle) * (v - middle);
  return std::sqrt(squares / static_cast<double>(values.size()));
}

TEST(TheilSen, SlopeAndInterceptAreMedians) {
  // Slopes 1/2, 2/3, 3/4, 1, 1, 1; y - 7/8 x is 0, 1/8, 1/4, -1/2; x has its median at 3/2.
  const auto fit =
      fit_line_theil_sen(std::vector<Vec2>{{0.0, 0.0}, {1.0, 1.0}, {2.0, 2.0}, {4.0, 3.0}}).value();
  EXPECT_DOUBLE_EQ(slope_of(fit.line), 0.875);
  EXPECT_EQ(fit.line.centroid, (Vec2{1.5, 0.875 * 1.5 + 0.0625}));
  EXPECT_DOUBLE_EQ(fit.residuals.signed_m[0],
                   -0.0625 / std::hypot(1.0, 0.875));  // orthogonal, as of other lines
}

TEST(TheilSen, RunsAlongTheLongerAxisUnlessToldOtherwise) {
  const std::vector<Vec2> upright{{3.0, 0.0}, {3.0, 1.0}, {3.0, 2.0}, {3.5, 3.0}};
  EXPECT_EQ(longer_axis(upright), RegressionAxis::kY);
  EXPECT_EQ(longer_axis(std::vector<Vec2>{{0.0, 0.0}, {1.0, 1.0}}), RegressionAxis::kX);
  const auto fit = fit_line_theil_sen(std::span(upright).first(3)).value();
  EXPECT_EQ(fit.line.direction, (Vec2{0.0, 1.0}));
  EXPECT_EQ(fit.line.centroid, (Vec2{3.0, 1.0}));
  EXPECT_FALSE(fit_line_theil_sen(std::span(upright).first(3), {.axis = RegressionAxis::kX}));
  EXPECT_DOUBLE_EQ(theil_sen_slope(upright).value(), 0.5 * (0.0 + 1.0 / 6.0));  // 0, 0, 0, 1/6, 1/4, 1/2
  EXPECT_DOUBLE_EQ(theil_sen_slope(upright, {.axis = RegressionAxis::kX}).value(), 4.0);  // 2, 4, 6
}

TEST(TheilSen, WithoutAPairThatHasASlopeThereIsNone) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const std::vector<std::vector<Vec2>> degenerate{{},
                                                  {{1.0, 2.0}},
                                                  {{1.0, 2.0}, {1.0, 2.0}},
                                                  {{0.0, 0.0}, {5e-4, 5e-4}},
                                                  {{0.0, 0.0}, {1.0, kNan}, {2.0, 0.0}},
                                                  {{0.0, 0.0}, {1.0, 0.0}, {kInfinity, 0.0}}};
  for (const auto& points : degenerate) {
    EXPECT_FALSE(fit_line_theil_sen(points));
    EXPECT_FALSE(theil_sen_slope(points));
    EXPECT_FALSE(slope_spread95(points));
    EXPECT_FALSE(ci_sen(points));
    EXPECT_FALSE(ci_bootstrap599(points, 1));
    EXPECT_TRUE(sampled_slopes(points, 10, 1).empty());
  }
}

TEST(TheilSen, TwoPointsAreTheirOwnInterval) {
  const std::vector<Vec2> points{{0.0, 0.0}, {4.0, 1.0}};
  for (const auto& interval : {ci_sen(points), ci_bootstrap599(points, 1), slope_spread95(points)}) {
    EXPECT_DOUBLE_EQ(interval.value().low, 0.25);
    EXPECT_DOUBLE_EQ(interval.value().high, 0.25);
  }
}

TEST(TheilSen, BreaksDownBetween29And29AndAHalfPercent) {
  EXPECT_NEAR(kTheilSenBreakdown, 0.2929, 5e-5);
  const auto slope_with = [](int bad) {  // of 200 points on slope 0.2, the last `bad` on a steep line
    std::vector<Vec2> points;
    for (int i = 0; i < 200; ++i) points.push_back({0.1 * i, i < 200 - bad ? 0.02 * i : 100.0 + 5.0 * i});
    return theil_sen_slope(points, {.axis = RegressionAxis::kX}).value();
  };
  EXPECT_NEAR(slope_with(58), 0.2, 1e-12);  // 29.0 %
  EXPECT_GT(slope_with(59), 1.0);           // 29.5 %
}

TEST(TheilSen, OrdinaryLeastSquaresBreaksDownWithOnePoint) {
  auto points = example(1);
  points[59].y += 100.0;
  EXPECT_NEAR(slope_of(fit_line_theil_sen(points).value().line), 0.2, 0.01);
  EXPECT_GT(slope_of(fit_line_ordinary(points).value().line), 0.3);
}

TEST(PairSlopes, AreInTheOrderOfSortingThemAll) {
  std::mt19937 engine(3);
  std::normal_distribution<double> normal(0.0, 1.0);
  for (const std::size_t size : {2U, 7U, 24U, 25U, 60U, 300U}) {
    for (const double step : {0.0, 0.01, 0.25}) {  // coordinates in steps: many equal x, many equal slopes
      const auto in_steps = [=](double v) { return step > 0.0 ? step * std::round(v / step) : v; };
      std::vector<Vec2> points;
      for (std::size_t i = 0; i < size; ++i) {
        const double x = 5.0 * normal(engine);
        points.push_back({in_steps(x), in_steps(0.3 * x + (i % 4 == 0 ? 3.0 : 0.05) * normal(engine))});
      }
      const auto expected = sorted_slopes(points, 1e-3);
      PairSlopes slopes(points, 1e-3);
      ASSERT_EQ(slopes.size(), expected.size());
      for (const double share : {0.0, 0.01, 0.025, 0.4, 0.5, 0.73, 0.975, 1.0}) {
        const auto rank = static_cast<std::size_t>(share * static_cast<double>(expected.size() - 1));
        EXPECT_DOUBLE_EQ(slopes.at(static_cast<double>(rank)), expected[rank])
            << size << " points, steps of " << step << ", rank " << rank;
      }
      EXPECT_DOUBLE_EQ(slopes.median().value(), median(expected).value());
    }
  }
}

TEST(PairSlopes, HundredsOfThousandsOfEqualOnesAreOne) {
  std::vector<Vec2> points;
  for (int i = 0; i < 800; ++i) points.push_back({0.01 * i, i % 50 == 0 ? 2.0 : 1.0});
  EXPECT_EQ(PairSlopes(points, 1e-3).median(), 0.0);
}

TEST(PairSlopes, OfPointsBeyondTheMoonAreStillNumbers) {
  std::vector<Vec2> points;
  for (int i = 0; i < 100; ++i) points.push_back({0.01 * i, 1e15 + 0.01 * i});
  EXPECT_TRUE(std::isfinite(PairSlopes(points, 1e-3).median().value()));
}

TEST(TheilSen, TheMiddleOfThePairSlopesIsNoConfidenceInterval) {
  const auto points = example(1);
  const auto slopes = sorted_slopes(points, 1e-3);
  ASSERT_EQ(slopes.size(), 1770U);
  const auto spread = slope_spread95(points).value();
  EXPECT_NEAR(spread.low, percentile(slopes, 2.5).value(), 1e-12);    // 0.0072
  EXPECT_NEAR(spread.high, percentile(slopes, 97.5).value(), 1e-12);  // 0.4240
  const auto sen = ci_sen(points).value();                            // C = 1.96 sqrt(60 59 125 / 18) = 307.3
  EXPECT_DOUBLE_EQ(sen.low, slopes[731 - 1]);                         // (1770 - 307.3) / 2 = 731.4: 0.2000
  EXPECT_DOUBLE_EQ(sen.high, slopes[1039 + 1 - 1]);  // (1770 + 307.3) / 2 + 1 = 1039.6: 0.2100
  const auto bootstrap = ci_bootstrap599(points, 1).value();
  const auto width = [](SlopeInterval i) { return i.high - i.low; };
  EXPECT_GT(width(spread), 30.0 * width(sen));
  EXPECT_NEAR(width(bootstrap) / width(sen), 1.0, 0.4);
  const double slope = theil_sen_slope(points).value();
  EXPECT_TRUE(bootstrap.low < slope && slope < bootstrap.high && sen.low < slope && slope < sen.high);
}

TEST(TheilSen, SensIntervalHoldsTheSlopeIn95OfAHundredSamples) {
  int held = 0;
  for (std::uint32_t seed = 0; seed < 400; ++seed) {
    const auto sen = ci_sen(example(seed)).value();
    if (sen.low <= 0.2 && 0.2 <= sen.high) ++held;
  }
  EXPECT_NEAR(held / 400.0, 0.95, 0.033);  // three standard deviations
}

TEST(TheilSen, SixHundredPairsTellTheMedianWellAndTheEndsBadly) {
  const auto points = example(1);
  std::vector<double> medians, lows, highs;
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    const auto slopes = sampled_slopes(points, 600, seed);
    medians.push_back(median(slopes).value());
    lows.push_back(percentile(slopes, 2.5).value());
    highs.push_back(percentile(slopes, 97.5).value());
  }
  EXPECT_NEAR(deviation(medians), 0.0012, 0.0002);
  EXPECT_NEAR(mean(medians).value(), theil_sen_slope(points).value(), 0.0005);
  EXPECT_NEAR(deviation(lows), 0.037, 0.007);
  EXPECT_NEAR(deviation(highs), 0.046, 0.007);
}

TEST(TheilSen, TheSameSeedGivesTheSameSample) {
  const auto points = example(1);
  EXPECT_EQ(sampled_slopes(points, 50, 7), sampled_slopes(points, 50, 7));
  EXPECT_NE(sampled_slopes(points, 50, 7), sampled_slopes(points, 50, 8));
  EXPECT_EQ(ci_bootstrap599(points, 7).value().low, ci_bootstrap599(points, 7).value().low);
}

TEST(TheilSen, SamplesComeFromTheFewPairsThatHaveASlope) {
  std::vector<Vec2> points(500, Vec2{0.0, 0.0});
  points.push_back({2.0, 1.0});
  EXPECT_EQ(sampled_slopes(points, 20, 1, {.axis = RegressionAxis::kX}), std::vector<double>(20, 0.5));
}

TEST(TheilSen, FollowsItsPoints) {
  rc::check([](const testing::RawPlaces& raw) {
    const auto points = testing::places_of(raw);
    const TheilSenOptions along_x{.axis = RegressionAxis::kX};
    const auto slope = theil_sen_slope(points, along_x);
    RC_PRE(slope.has_value());
    const auto slope_after = [&](auto moved) {
      std::vector<Vec2> others;
      for (const Vec2 p : points) others.push_back(moved(p));
      std::ranges::reverse(others);
      return theil_sen_slope(others, along_x).value();
    };
    RC_ASSERT(slope_after([](Vec2 p) { return p; }) == *slope);
    RC_ASSERT(slope_after([](Vec2 p) { return p + Vec2{8.0, -4.0}; }) == *slope);
    RC_ASSERT(std::abs(slope_after([](Vec2 p) {
                         return Vec2{p.x, -p.y};
                       }) +
                       *slope) <= 1e-12 * std::abs(*slope));
    RC_ASSERT(std::abs(slope_after([](Vec2 p) {
                         return Vec2{-p.x, p.y};
                       }) +
                       *slope) <= 1e-12 * std::abs(*slope));
    RC_ASSERT(std::abs(slope_after([](Vec2 p) {
                         return Vec2{p.x, p.y + 2.0 * p.x};
                       }) -
                       *slope - 2.0) <= 1e-12 * (2.0 + std::abs(*slope)));
  });
}

}  // namespace
}  // namespace verge::fit
