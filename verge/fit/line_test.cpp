// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/fit/line.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <optional>
#include <random>
#include <span>
#include <vector>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "verge/fit/test_points.hpp"

namespace verge::fit {
namespace {

Vec2 turned(Vec2 p, double angle) {
  return {std::cos(angle) * p.x - std::sin(angle) * p.y, std::sin(angle) * p.x + std::cos(angle) * p.y};
}

/// Points every 0.25 m for 20 m along a line at `angle` through (1, 2), with Gaussian noise across it.
std::vector<Vec2> noisy_line(double angle, double sigma, std::uint32_t seed) {
  std::mt19937 engine(seed);
  std::normal_distribution<double> noise(0.0, sigma);
  std::vector<Vec2> points;
  for (int i = 0; i < 80; ++i) points.push_back(Vec2{1.0, 2.0} + turned({0.25 * i, noise(engine)}, angle));
  return points;
}

TEST(Line, ThroughTwoPointsIsExact) {
  const auto fit = fit_line(std::vector<Vec2>{{1.0, 1.0}, {4.0, 5.0}}).value();
  EXPECT_DOUBLE_EQ(fit.line.direction.x, 0.6);
  EXPECT_DOUBLE_EQ(fit.line.direction.y, 0.8);
  EXPECT_EQ(fit.line.centroid, (Vec2{2.5, 3.0}));
  EXPECT_NEAR(fit.residuals.rms_m, 0.0, 1e-15);
}

TEST(Line, StandingUprightPointsAlongPlusY) {
  const auto fit = fit_line(std::vector<Vec2>{{3.0, 5.0}, {3.0, -1.0}, {3.0, 2.0}}).value();
  EXPECT_EQ(fit.line.direction, (Vec2{0.0, 1.0}));
}

TEST(Line, ResidualsAreOrthogonalAndPositiveToTheLeft) {
  const std::vector<Vec2> points{{0.0, 0.0}, {10.0, 0.0}, {10.0, 1.0}, {0.0, 1.0}};
  const auto fit = fit_line(points).value();
  EXPECT_DOUBLE_EQ(fit.residuals.signed_m[0], -0.5);
  EXPECT_DOUBLE_EQ(fit.residuals.signed_m[3], 0.5);
  EXPECT_DOUBLE_EQ(fit.residuals.rms_m, 0.5);
  EXPECT_DOUBLE_EQ(fit.residuals.p95_m, 0.5);
}

TEST(Line, StationsRunFromTheCentroidAlongTheDirection) {
  const Line line{{1.0, 1.0}, {0.6, 0.8}};
  EXPECT_DOUBLE_EQ(station(line, {4.0, 5.0}), 5.0);
  EXPECT_DOUBLE_EQ(point_at(line, 5.0).x, 4.0);
  EXPECT_DOUBLE_EQ(point_at(line, 5.0).y, 5.0);
  EXPECT_DOUBLE_EQ(signed_distance(line, {1.0 - 0.8, 1.0 + 0.6}), 1.0);
}

TEST(Line, FewerThanTwoDistinctPointsGiveNone) {
  EXPECT_FALSE(fit_line({}).has_value());
  EXPECT_FALSE(fit_line(std::vector<Vec2>{{0.1, 0.1}}).has_value());
  EXPECT_FALSE(fit_line(std::vector<Vec2>(3, Vec2{0.1, 0.1})).has_value());
  EXPECT_FALSE(fit_line_robust(std::vector<Vec2>(3, Vec2{0.1, 0.1})).has_value());
  EXPECT_FALSE(fit_line(std::vector<Vec2>{{0.0, 0.0}, {1.0, 0.0}}, std::vector<double>{1.0, 0.0}));
}

TEST(Line, CoordinatesThatAreNotFiniteGiveNone) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  EXPECT_FALSE(fit_line(std::vector<Vec2>{{0.0, 0.0}, {1.0, kNan}}));
  EXPECT_FALSE(fit_line(std::vector<Vec2>{{0.0, 0.0}, {kInfinity, 1.0}}));
  EXPECT_FALSE(fit_line_ordinary(std::vector<Vec2>{{0.0, 0.0}, {1.0, kNan}}));
}

TEST(Line, OrdinaryLeastSquaresGivesTheTextbooksSlope) {
  // x = 1, 2, 3, 4 and y = 6, 5, 7, 10: y = 3.5 + 1.4 x.
  const auto fit =
      fit_line_ordinary(std::vector<Vec2>{{1.0, 6.0}, {2.0, 5.0}, {3.0, 7.0}, {4.0, 10.0}}).value();
  EXPECT_NEAR(fit.line.direction.y / fit.line.direction.x, 1.4, 1e-12);
  EXPECT_NEAR(fit.line.centroid.y - 1.4 * fit.line.centroid.x, 3.5, 1e-12);
}

TEST(Line, OrdinaryLeastSquaresHasNoUprightLine) {
  EXPECT_FALSE(fit_line_ordinary(std::vector<Vec2>{{3.0, 5.0}, {3.0, -1.0}}).has_value());
}

TEST(Line, OrdinaryLeastSquaresFlattensASteepLineThatTotalLeastSquaresFollows) {
  const auto points = noisy_line(80.0 * std::numbers::pi / 180.0, 0.5, 1);
  const auto slope_of = [](const Line& line) { return std::atan2(line.direction.y, line.direction.x); };
  const double total = slope_of(fit_line(points).value().line);
  const double ordinary = slope_of(fit_line_ordinary(points).value().line);
  EXPECT_NEAR(total, 80.0 * std::numbers::pi / 180.0, 0.03);
  EXPECT_LT(ordinary, total - 0.02);
}

TEST(Line, AloneIsTheLineOfTheFit) {
  const auto points = noisy_line(0.4, 0.1, 7);
  std::vector<double> weights(points.size(), 1.0);
  weights[3] = 0.0;
  weights[50] = 5.0;
  const auto expect_same = [](const std::optional<Line>& line, const std::optional<LineFit>& fit) {
    ASSERT_TRUE(line && fit);
    EXPECT_EQ(line->centroid, fit->line.centroid);
    EXPECT_EQ(line->direction, fit->line.direction);
  };
  expect_same(orthogonal_line(points, weights), fit_line(points, weights));
  expect_same(ordinary_line(points, weights), fit_line_ordinary(points, weights));
  EXPECT_FALSE(orthogonal_line(std::span(points).first(1)));
  EXPECT_FALSE(ordinary_line(std::vector<Vec2>{{1.0, 0.0}, {1.0, 3.0}}));
}

TEST(Line, RobustFitIsTheLineOfItsOwnWeights) {
  auto points = noisy_line(0.4, 0.1, 7);
  points[10] = points[10] + Vec2{0.0, 4.0};
  const auto robust = fit_line_robust(points).value();
  const auto again = orthogonal_line(points, robust.weights).value();
  EXPECT_EQ(again.centroid, robust.line.centroid);
  EXPECT_EQ(again.direction, robust.line.direction);
  EXPECT_EQ(robust.weights[10], 0.0);
  EXPECT_NEAR(robust.residuals.signed_m[10], 4.0 * std::cos(0.4), 0.3);
}

TEST(Line, RobustFitIgnoresAWallBehindTheKerb) {
  auto points = noisy_line(0.1, 0.02, 2);
  const Vec2 across = turned({0.0, 2.0}, 0.1);
  for (std::size_t i = 0; i < points.size(); i += 3) points[i] = points[i] + across;
  const auto robust = fit_line_robust(points).value();
  EXPECT_LT(std::abs(signed_distance(robust.line, Vec2{1.0, 2.0} + turned({10.0, 0.0}, 0.1))), 0.01);
  EXPECT_NEAR(std::atan2(robust.line.direction.y, robust.line.direction.x), 0.1, 0.002);
  EXPECT_DOUBLE_EQ(robust.weights[0], 0.0);
  EXPECT_GT(robust.weights[1], 0.5);
  EXPECT_GT(robust.residuals.p95_m, 1.9);  // the wall's points still count in the figures
  EXPECT_GT(std::abs(signed_distance(fit_line(points).value().line, {1.0, 2.0})), 0.3);
}

TEST(Line, RobustFitOfExactPointsIsExactInSpiteOfAnOutlier) {
  std::vector<Vec2> points;
  for (int i = 0; i < 20; ++i) points.push_back({0.5 * i, 1.0});
  points.push_back({5.0, 9.0});
  const auto fit = fit_line_robust(points).value();
  EXPECT_NEAR(signed_distance(fit.line, {0.0, 1.0}), 0.0, 1e-9);
  EXPECT_NEAR(fit.line.direction.y, 0.0, 1e-9);
}

TEST(Line, NoLineLiesNearerInTheSumOfSquares) {
  rc::check([](const testing::RawPlaces& raw, std::int8_t turn, std::int8_t shift) {
    const auto points = testing::places_of(raw);
    const auto fit = fit_line(points);
    RC_PRE(fit.has_value());
    const auto cost = [&](const Line& line) {
      double sum = 0.0;
      for (const Vec2 p : points) sum += signed_distance(line, p) * signed_distance(line, p);
      return sum;
    };
    Line other = fit->line;
    other.direction = turned(other.direction, turn / 80.0);
    other.centroid = other.centroid + Vec2{0.0, shift / 80.0};
    RC_ASSERT(cost(fit->line) <= cost(other) + 1e-9 * (1.0 + cost(other)));
  });
}

TEST(Line, TurnsWithItsPoints) {
  rc::check([](const testing::RawPlaces& raw, std::int8_t turn) {
    const auto points = testing::places_of(raw);
    const auto fit = fit_line(points);
    RC_PRE(fit.has_value());
    std::vector<Vec2> moved;
    for (const Vec2 p : points) moved.push_back(Vec2{3.0, -7.0} + turned(p, turn / 20.0));
    const auto again = fit_line(moved).value();
    RC_ASSERT(std::abs(again.residuals.rms_m - fit->residuals.rms_m) < 1e-8);
    for (std::size_t i = 0; i < points.size(); ++i)
      RC_ASSERT(std::abs(norm(points[i] - fit->line.centroid) - norm(moved[i] - again.line.centroid)) < 1e-8);
  });
}

TEST(Line, MirroringThePointsMirrorsTheLineBitForBit) {
  rc::check([](const testing::RawPlaces& raw) {
    auto points = testing::places_of(raw);
    const auto fit = fit_line_robust(points);
    RC_PRE(fit.has_value());
    for (Vec2& p : points) p.y = -p.y;
    const auto mirrored = fit_line_robust(points).value();
    RC_ASSERT(mirrored.line.centroid == (Vec2{fit->line.centroid.x, -fit->line.centroid.y}));
    RC_ASSERT(mirrored.line.direction.x == fit->line.direction.x);
    RC_ASSERT(std::abs(mirrored.line.direction.y) == std::abs(fit->line.direction.y));
    RC_ASSERT(mirrored.residuals.rms_m == fit->residuals.rms_m);
  });
}

TEST(Line, AWeightOfZeroLeavesThePointOutAndAWeightOfTwoCountsItTwice) {
  rc::check([](const testing::RawPlaces& raw) {
    const auto points = testing::places_of(raw);
    std::vector<double> weights;
    std::vector<Vec2> repeated;
    for (std::size_t i = 0; i < points.size(); ++i) {
      weights.push_back(static_cast<double>(i % 3));
      repeated.insert(repeated.end(), i % 3, points[i]);
    }
    const auto weighted = fit_line(points, weights);
    const auto plain = fit_line(repeated);
    RC_ASSERT(weighted.has_value() == plain.has_value());
    RC_PRE(plain.has_value());
    RC_ASSERT(norm(weighted->line.centroid - plain->line.centroid) < 1e-9);
    RC_ASSERT(std::abs(weighted->residuals.rms_m - plain->residuals.rms_m) < 1e-8);
  });
}

}  // namespace
}  // namespace verge::fit
