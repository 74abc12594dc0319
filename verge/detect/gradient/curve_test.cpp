// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/detect/gradient/curve.hpp"

#include <algorithm>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "verge/core/polyline.hpp"

namespace verge::detect::gradient {
namespace {

std::vector<Vec2> line_points() {
  std::vector<Vec2> points;
  for (int i = 0; i <= 20; ++i) points.push_back({-10.0 + i, 3.0 + 0.02 * i});
  return points;
}

constexpr double kRadius = 20.0;

/// 15 m straight, then an arc of radius 20 m to the left.
Vec2 road_at(double s) {
  if (s <= 15.0) return {s, 0.0};
  const double turn = (s - 15.0) / kRadius;
  return {15.0 + kRadius * std::sin(turn), kRadius * (1.0 - std::cos(turn))};
}

double distance_to_road(Vec2 p) {
  const double to_arc = std::abs(distance(p, {15.0, kRadius}) - kRadius);
  return p.x <= 15.0 ? std::abs(p.y) : to_arc;
}

std::vector<Vec2> bend_points(double sigma) {
  std::mt19937 random(7);
  std::normal_distribution<double> unit;
  std::vector<Vec2> points;
  for (double s = 0.0; s <= 30.7; s += 0.25)
    points.push_back(road_at(s) + sigma * Vec2{unit(random), unit(random)});
  return points;
}

double rms_to_road(const Curve& curve) {
  double sum = 0.0;
  for (const Vec2 p : curve.points) sum += distance_to_road(p) * distance_to_road(p);
  return std::sqrt(sum / static_cast<double>(curve.points.size()));
}

TEST(FitCurve, AStraightRoadIsALineFromItsFirstToItsLastPoint) {
  const auto points = line_points();
  const auto curve = fit_curve(points, {});
  ASSERT_TRUE(curve.has_value());
  EXPECT_EQ(curve->model, Model::kLine);
  EXPECT_LT(distance(curve->points.front(), points.front()), 1e-6);
  EXPECT_LT(distance(curve->points.back(), points.back()), 1e-6);
  EXPECT_TRUE(curve->key_points.empty());
}

TEST(FitCurve, OneOutlierDoesNotMoveTheLine) {
  auto points = line_points();
  points[7].y += 0.6;
  const auto curve = fit_curve(points, {});
  ASSERT_TRUE(curve.has_value());
  for (const Vec2 p : curve->points) EXPECT_LT(std::abs(p.y - (3.0 + 0.02 * (p.x + 10.0))), 0.03);
}

TEST(FitCurve, ABendIsASplineNearTheTruth) {
  for (const double sigma : {0.0, 0.01, 0.03, 0.05}) {
    const auto curve = fit_curve(bend_points(sigma), {});
    ASSERT_TRUE(curve.has_value());
    EXPECT_EQ(curve->model, Model::kSpline);
    EXPECT_LT(rms_to_road(*curve), 0.02 + 0.4 * sigma) << sigma;  // better than the points themselves
  }
}

TEST(FitCurve, TheSplinePassesThroughItsKeyPoints) {
  const auto curve = fit_curve(bend_points(0.02), {});
  ASSERT_TRUE(curve.has_value());
  ASSERT_GE(curve->key_points.size(), 4U);
  EXPECT_LT(curve->key_points.size(),
            bend_points(0.02).size() / 2);  // "smaller than half of the number of points"
  for (const Vec2 q : curve->key_points) EXPECT_LT(distance_to(curve->points, q), 0.01);
}

TEST(FitCurve, KeepsTheIntermediatesOfItsSpline) {
  const auto curve = fit_curve(bend_points(0.02), {});
  ASSERT_TRUE(curve.has_value());
  const std::size_t n = curve->key_points.size();
  EXPECT_EQ(curve->control_points.size(), n);
  EXPECT_EQ(curve->U.size(), n + 4);
  ASSERT_EQ(curve->u.size(), n);
  EXPECT_EQ(curve->u.front(), 0.0);
  EXPECT_EQ(curve->u.back(), 1.0);
  // Eq. (5): u_{j+p} = (1/p) sum of p parameters, p = 3
  EXPECT_NEAR(curve->U[4], (curve->u[1] + curve->u[2] + curve->u[3]) / 3.0, 1e-12);
  const double sharpest = *std::max_element(curve->kappa.begin(), curve->kappa.end());
  EXPECT_NEAR(sharpest, 1.0 / kRadius, 0.03);
}

TEST(FitCurve, TellsWhereThePointsOfTheCurvatureAndTheKeyPointsLie) {
  for (const auto& curve : {fit_curve(bend_points(0.02), {}), fit_curve_as_printed(bend_points(0.02), {})}) {
    ASSERT_TRUE(curve.has_value());
    ASSERT_EQ(curve->s.size(), curve->kappa.size());
    ASSERT_EQ(curve->key_s.size(), curve->key_points.size());
    EXPECT_EQ(curve->key_s.front(), 0.0);
    EXPECT_EQ(curve->key_s.back(), curve->s.back());
    const double step = distance(curve->key_points[0], curve->key_points[1]);
    EXPECT_GE(curve->key_s[1], step - 1e-9);  // along the points is no shorter than straight
  }
}

TEST(FitCurve, ReversingThePointsReversesTheCurve) {
  auto points = bend_points(0.02);
  const auto forth = fit_curve(points, {});
  std::reverse(points.begin(), points.end());
  const auto back = fit_curve(points, {});
  ASSERT_TRUE(forth && back);
  for (const Vec2 p : back->points) EXPECT_LT(distance_to(forth->points, p), 0.01);
  EXPECT_LT(distance(forth->points.front(), back->points.back()), 0.01);
}

TEST(FitCurve, AsPrintedInterpolatesTheNoise) {
  const auto fixed = fit_curve(bend_points(0.03), {});
  const auto printed = fit_curve_as_printed(bend_points(0.03), {});
  ASSERT_TRUE(fixed && printed);
  EXPECT_EQ(printed->model, Model::kSpline);
  EXPECT_GT(rms_to_road(*printed),
            1.5 * rms_to_road(*fixed));  // why the fixed reading smooths first (A2.2-6)
}

TEST(FitCurve, ByBicAGentleBendIsNoLineWhereTheFeetAreGood) {
  // 0.27 m off a line at most, many feet as good as 1 cm.
  GradientConfig by_bic;
  by_bic.straight_by = StraightRule::kBic;
  std::mt19937 random(3);
  std::normal_distribution<double> noise(0.0, 0.01);
  std::vector<Vec2> points;
  for (double x = -20.0; x <= 20.0; x += 0.25) points.push_back({x, x * x / 1000.0 + noise(random)});
  GradientConfig by_residual;
  by_residual.line_residual_m = 0.3;
  EXPECT_EQ(fit_curve(points, by_residual)->model, Model::kLine);
  EXPECT_EQ(fit_curve(points, by_bic)->model, Model::kSpline);
}

TEST(FitCurve, ByBicNoiseIsNoBend) {
  GradientConfig config;
  config.straight_by = StraightRule::kBic;
  int splines = 0;
  for (unsigned seed = 0; seed < 20; ++seed) {
    std::mt19937 random(seed);
    std::normal_distribution<double> noise(0.0, 0.05);
    auto points = line_points();
    for (Vec2& p : points) p.y += noise(random);
    if (fit_curve(points, config)->model == Model::kSpline) ++splines;
  }
  EXPECT_LE(splines, 1);
}

TEST(FitCurve, ByLeastSquaresIsNearTheTruthAndHasNoKeyPoints) {
  for (const fit::KnotPlacement knots : {fit::KnotPlacement::kAveraged, fit::KnotPlacement::kUniform}) {
    GradientConfig config;
    config.spline = SplineKind::kLeastSquares;
    config.knots = knots;
    const auto curve = fit_curve(bend_points(0.03), config);
    ASSERT_TRUE(curve.has_value());
    EXPECT_EQ(curve->model, Model::kSpline);
    EXPECT_LT(rms_to_road(*curve), 0.02);
    EXPECT_TRUE(curve->key_points.empty());
    EXPECT_EQ(curve->U.size(), curve->control_points.size() + 4);
    EXPECT_EQ(curve->kappa.size(), curve->points.size());
  }
}

TEST(FitCurve, UniformKnotsAreEvenWhereTheyDetermineACurve) {
  GradientConfig config;
  config.knots = fit::KnotPlacement::kUniform;
  const auto curve = fit_curve(bend_points(0.0), config);
  ASSERT_TRUE(curve.has_value());
  EXPECT_LT(rms_to_road(*curve), 0.02);
  for (std::size_t j = 4; j + 4 < curve->U.size(); ++j)
    EXPECT_NEAR(curve->U[j + 1] - curve->U[j], curve->U[4], 1e-12);
}

TEST(FitCurve, TooFewPointsGiveNone) {
  EXPECT_FALSE(fit_curve({}, {}).has_value());
  EXPECT_FALSE(fit_curve(std::vector<Vec2>{{1.0, 1.0}, {1.0, 1.0}}, {}).has_value());
  EXPECT_FALSE(fit_curve_as_printed({}, {}).has_value());
  EXPECT_FALSE(fit_curve_as_printed(std::vector<Vec2>{{1.0, 1.0}}, {}).has_value());
}

}  // namespace
}  // namespace verge::detect::gradient
