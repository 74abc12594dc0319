// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/fit/bspline_least_squares.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <optional>
#include <random>
#include <span>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "verge/core/polyline.hpp"
#include "verge/fit/bspline_interpolation.hpp"
#include "verge/fit/curvature.hpp"
#include "verge/fit/knots.hpp"
#include "verge/fit/path.hpp"

namespace verge::fit {
namespace {

/// The course of A2.2-6 at arc length s: 15 m straight ahead, then a left-hand arc of 20 m radius over 15.7
/// m.
Vec2 course(double s) {
  const double turn = std::max(0.0, (s - 15.0) / 20.0);
  return {std::min(s, 15.0) + 20.0 * std::sin(turn), 20.0 * (1.0 - std::cos(turn))};
}

std::vector<Vec2> noisy_course(double step, double sigma, std::uint32_t seed) {
  std::mt19937 engine(seed);
  std::normal_distribution<double> noise(0.0, 1.0);
  std::vector<Vec2> points;
  for (double s = 0.0; s <= 30.7; s += step) {
    const double x = sigma * noise(engine);
    const double y = sigma * noise(engine);
    points.push_back(course(s) + Vec2{x, y});
  }
  return points;
}

/// Distance of p from the course, whose line and arc both go on beyond their ends.
double distance_from_course(Vec2 p) {
  return p.x <= 15.0 ? std::abs(p.y) : std::abs(distance(p, {15.0, 20.0}) - 20.0);
}

/// Root mean square distance of the curve from the course.
double error_of(const BSpline& curve) {
  double squares = 0.0;
  const auto points = sample(curve, 0.1);
  for (const Vec2 p : points) squares += distance_from_course(p) * distance_from_course(p);
  return std::sqrt(squares / static_cast<double>(points.size()));
}

TEST(LeastSquaresSpline, ReproducesACubicWhateverItsKnots) {
  const auto cubic = [](double u) { return Vec2{10.0 * u, 4.0 * u * u * u - 3.0 * u * u + u}; };
  std::vector<double> u;
  std::vector<Vec2> points;
  for (int i = 0; i <= 40; ++i) u.push_back(std::pow(i / 40.0, 1.3));
  for (const double v : u) points.push_back(cubic(v));
  const std::vector<double> knots{0.0, 0.0, 0.0, 0.0, 0.2, 0.3, 0.75, 1.0, 1.0, 1.0, 1.0};
  const auto curve = least_squares_spline(points, {}, u, knots, 3, 0.0).value();
  for (int i = 0; i <= 100; ++i) EXPECT_LT(distance(evaluate(curve, i / 100.0), cubic(i / 100.0)), 1e-9);
}

TEST(LeastSquaresSpline, ReproducesAnEvenStraightLineWhateverThePenalty) {
  std::vector<double> u;
  std::vector<Vec2> points;
  for (int i = 0; i <= 40; ++i) u.push_back(i / 40.0);
  for (const double v : u) points.push_back({3.0 + 20.0 * v, 1.0 - 5.0 * v});
  const auto curve = least_squares_spline(points, {}, u, uniform_knots(9, 3), 3, 1e6).value();
  for (int i = 0; i <= 50; ++i)
    EXPECT_LT(distance(evaluate(curve, i / 50.0), {3.0 + 20.0 * i / 50.0, 1.0 - 5.0 * i / 50.0}), 1e-6);
}

TEST(LeastSquaresSpline, WithAsManyControlPointsAsPointsInterpolates) {
  const std::vector<Vec2> q{{0.0, 0.0}, {4.0, 0.2}, {7.0, 1.0}, {9.0, 3.0}, {9.5, 6.0}, {9.6, 12.0}};
  const auto through = interpolate(q).value();
  const auto u = parameters(q, Parameterization::kCentripetal).value();
  const auto nearest = least_squares_spline(q, {}, u, through.knots, 3, 0.0).value();
  for (std::size_t i = 0; i < q.size(); ++i)
    EXPECT_LT(distance(nearest.control_points[i], through.control_points[i]), 1e-9);
}

TEST(LeastSquaresSpline, ASpanWithoutPointsNeedsThePenalty) {
  const std::vector<double> u{0.0, 0.02, 0.04, 0.06, 0.08, 0.94, 0.96, 0.98, 1.0};
  std::vector<Vec2> points;
  for (const double v : u) points.push_back({30.0 * v, 1.0});
  EXPECT_FALSE(least_squares_spline(points, {}, u, uniform_knots(9, 3), 3, 0.0).has_value());
  const auto bridged = least_squares_spline(points, {}, u, uniform_knots(9, 3), 3, 0.1).value();
  EXPECT_LT(distance(evaluate(bridged, 0.5), {15.0, 1.0}), 1e-6);
}

TEST(LeastSquaresSpline, WithoutAnyWeightIsNone) {
  const std::vector<double> u{0.0, 0.3, 0.6, 1.0};
  const std::vector<Vec2> points{{0.0, 0.0}, {1.0, 0.0}, {2.0, 0.0}, {3.0, 0.0}};
  EXPECT_FALSE(least_squares_spline(points, std::vector<double>(4, 0.0), u, uniform_knots(4, 3), 3, 0.1));
}

/// A2.2-6: RMS to the truth, and by how many times interpolation at key points is worse than least squares.
struct Pitfall {
  double sigma, at_key_points, at_every_tenth, least_squares, factor;
};

class KeyPointPitfall : public ::testing::TestWithParam<Pitfall> {};

TEST_P(KeyPointPitfall, InterpolationAtTheSharpestPointsFitsTheirNoise) {
  const Pitfall& stated = GetParam();
  constexpr std::uint32_t kSeeds = 40;
  constexpr std::size_t kControlPoints = 10;
  double at_key_points = 0.0;
  double at_every_tenth = 0.0;
  double least_squares = 0.0;
  for (std::uint32_t seed = 1; seed <= kSeeds; ++seed) {
    const auto points = noisy_course(0.25, stated.sigma, seed);
    at_key_points += error_of(interpolate(gather(points, key_points(curvature(points)))).value()) / kSeeds;
    std::vector<Vec2> every_tenth;  // 2.5 m apart
    for (std::size_t i = 0; i < points.size(); i += 10) every_tenth.push_back(points[i]);
    at_every_tenth += error_of(interpolate(every_tenth).value()) / kSeeds;
    const auto u = parameters(points, Parameterization::kChordLength).value();
    const auto knots = least_squares_knots(u, kControlPoints, 3);
    least_squares += error_of(least_squares_spline(points, {}, u, knots, 3, 0.0).value()) / kSeeds;
  }
  EXPECT_NEAR(at_key_points, stated.at_key_points, 0.35 * stated.at_key_points);
  EXPECT_NEAR(at_every_tenth, stated.at_every_tenth, 0.2 * stated.at_every_tenth);
  EXPECT_NEAR(least_squares, stated.least_squares, 0.25 * stated.least_squares);
  EXPECT_GE(at_key_points, stated.factor * least_squares);
}

INSTANTIATE_TEST_SUITE_P(OfThePapersCourse, KeyPointPitfall,
                         ::testing::Values(Pitfall{0.01, 0.014, 0.010, 0.003, 4.7},
                                           Pitfall{0.03, 0.046, 0.032, 0.008, 5.7},
                                           Pitfall{0.05, 0.078, 0.047, 0.016, 4.9}));

TEST(SplineFit, ErrorsOfThePapersCourseAreThoseOfFewControlPoints) {
  const std::vector<std::pair<double, double>> sigma_and_bar{{0.01, 0.007}, {0.03, 0.012}, {0.05, 0.018}};
  for (const auto& [sigma, bar] : sigma_and_bar) {
    double fitted = 0.0;
    for (std::uint32_t seed = 1; seed <= 10; ++seed)
      fitted += error_of(fit_spline(noisy_course(0.25, sigma, seed)).value().curve) / 10.0;
    EXPECT_LT(fitted, bar) << sigma;
  }
}

TEST(SplineFit, DensePointsThatZigzagDoNotStretchTheParameters) {
  // 2 cm of noise at 1 cm spacing: the polyline through the points is several times as long as the course.
  const auto points = noisy_course(0.01, 0.02, 4);
  EXPECT_GT(length(points), 60.0);
  const auto fit = fit_spline(points).value();
  EXPECT_LT(error_of(fit.curve), 0.006);
  EXPECT_NEAR(fit.residuals.rms_m, 0.02, 0.001);
  EXPECT_NEAR(fit.residuals.p95_m, 0.0392, 0.002);
}

TEST(SplineFit, TheCurveAloneIsThatOfTheFit) {
  const auto points = noisy_course(0.4, 0.05, 3);
  for (const auto& robust : {std::optional<RobustOptions>{}, std::optional(RobustOptions{})}) {
    const SplineFitOptions options{.robust = robust};
    const auto fit = fit_spline(points, options).value();
    const auto alone = spline_near(points, options).value();
    EXPECT_EQ(alone.knots, fit.curve.knots);
    EXPECT_EQ(alone.control_points, fit.curve.control_points);
  }
  EXPECT_FALSE(spline_near(std::span(points).first(1)));
}

TEST(SplineFit, RobustFitIgnoresAWallBehindTheKerb) {
  for (std::uint32_t seed = 1; seed <= 5; ++seed) {
    auto points = noisy_course(0.1, 0.02, seed);
    for (std::size_t i = 0; i < points.size(); i += 3) points[i] = points[i] + Vec2{-0.9, 1.2};
    EXPECT_GT(error_of(fit_spline(points).value().curve), 0.2);
    const auto robust = fit_spline(points, {.robust = RobustOptions{}}).value();
    EXPECT_LT(error_of(robust.curve), 0.012) << seed;
    EXPECT_EQ(robust.weights[99], 0.0);
    EXPECT_GT(robust.residuals.p95_m, 0.8);  // the wall's points still count in the figures
  }
}

TEST(SplineFit, ABendOfARightAngleWithUnequalLegsKeepsItsShape) {
  // 20 m ahead, an arc of 8 m radius over 85 degrees, 6 m further: the short leg stands steep on the axis.
  const double last = 85.0 * std::numbers::pi / 180.0;
  const auto at = [last](double s) {
    const double turn = std::clamp((s - 20.0) / 8.0, 0.0, last);
    const Vec2 arc{std::min(s, 20.0) + 8.0 * std::sin(turn), 8.0 * (1.0 - std::cos(turn))};
    return arc + std::max(0.0, s - 20.0 - 8.0 * last) * Vec2{std::cos(last), std::sin(last)};
  };
  std::vector<Vec2> points;
  std::vector<Vec2> truth;
  for (int i = 0; i <= 378; ++i) truth.push_back(at(0.1 * i));
  for (int i = 0; i <= 126; ++i) points.push_back(at(0.3 * i));
  const auto fit = fit_spline(points).value();
  for (const Vec2 p : sample(fit.curve, 0.2)) EXPECT_LT(distance_to(truth, p), 0.04);
  EXPECT_NEAR(length(fit.curve), 37.8, 0.05);
  EXPECT_EQ(fit.curve.control_points.size(), 13U + 3U);  // a span every 3 m of arc length, not of the axis
}

TEST(SplineFit, TheOrderOfThePointsBetweenTheFirstAndTheLastPlaysNoPart) {
  const auto points = noisy_course(0.25, 0.03, 9);
  auto shuffled = points;
  std::mt19937 engine(1);
  std::shuffle(shuffled.begin() + 1, shuffled.end() - 1, engine);
  for (const KnotPlacement knots : {KnotPlacement::kUniform, KnotPlacement::kAveraged}) {
    const SplineFitOptions options{.knots = knots, .robust = RobustOptions{}};
    const auto fit = fit_spline(points, options).value();
    const auto again = fit_spline(shuffled, options).value();
    for (int i = 0; i <= 50; ++i)
      EXPECT_LT(distance(evaluate(fit.curve, i / 50.0), evaluate(again.curve, i / 50.0)), 1e-8);
  }
}

TEST(SplineFit, AStraightRowOfPointsGivesTheStraightLine) {
  std::vector<Vec2> points;
  for (int i = 0; i < 60; ++i) points.push_back({0.3 * i, 2.0 + 0.1 * i});
  const auto fit = fit_spline(points).value();
  EXPECT_LT(fit.residuals.rms_m, 1e-9);
  EXPECT_LT(distance(evaluate(fit.curve, 0.0), points.front()), 1e-6);
  EXPECT_LT(distance(evaluate(fit.curve, 1.0), points.back()), 1e-6);
}

TEST(SplineFit, ResidualsArePositiveToTheLeft) {
  std::vector<Vec2> points;
  for (int i = 0; i < 40; ++i) points.push_back({0.25 * i, i % 2 == 0 ? 0.1 : -0.1});
  const auto fit = fit_spline(points).value();
  EXPECT_NEAR(fit.residuals.signed_m[20], 0.1, 0.02);
  EXPECT_NEAR(fit.residuals.signed_m[21], -0.1, 0.02);
}

TEST(SplineFit, TooFewOrCoincidingPointsGiveNone) {
  EXPECT_FALSE(fit_spline({}).has_value());
  EXPECT_FALSE(fit_spline(std::vector<Vec2>{{1.0, 1.0}}).has_value());
  EXPECT_FALSE(fit_spline(std::vector<Vec2>(5, Vec2{1.0, 1.0})).has_value());
  EXPECT_FALSE(fit_spline(std::vector<Vec2>{{0.0, 0.0}, {1.0, std::nan("")}, {2.0, 0.0}}).has_value());
}

TEST(SplineFit, TwoAndThreePointsLowerTheDegree) {
  const auto two = fit_spline(std::vector<Vec2>{{0.0, 0.0}, {3.0, 4.0}}).value();
  EXPECT_EQ(two.curve.degree, 1U);
  EXPECT_LT(distance(evaluate(two.curve, 1.0), {3.0, 4.0}), 1e-9);
  EXPECT_EQ(fit_spline(std::vector<Vec2>{{0.0, 0.0}, {1.0, 1.0}, {2.0, 0.0}}).value().curve.degree, 2U);
}

TEST(SplineFit, MovesAndTurnsWithItsPointsAndMirrorsWithThem) {
  const auto points = noisy_course(0.25, 0.03, 6);
  const SplineFitOptions options{.robust = RobustOptions{}};
  const auto fit = fit_spline(points, options).value();
  std::vector<Vec2> turned;
  std::vector<Vec2> mirrored;
  for (const Vec2 p : points) turned.push_back({100.0 - p.y, p.x - 50.0});
  for (const Vec2 p : points) mirrored.push_back({p.x, -p.y});
  const auto after = fit_spline(turned, options).value();
  const auto mirror = fit_spline(mirrored, options).value();
  for (int i = 0; i <= 50; ++i) {
    const Vec2 p = evaluate(fit.curve, i / 50.0);
    EXPECT_LT(distance(evaluate(after.curve, i / 50.0), {100.0 - p.y, p.x - 50.0}), 1e-6);
    EXPECT_EQ(evaluate(mirror.curve, i / 50.0), (Vec2{p.x, -p.y}));
  }
}

TEST(SplineFit, ReversedPointsGiveTheSameCurveBackwards) {
  auto points = noisy_course(0.25, 0.03, 7);
  const auto there = fit_spline(points).value();
  std::ranges::reverse(points);
  const auto back = fit_spline(points).value();
  for (int i = 0; i <= 50; ++i)
    EXPECT_LT(distance(evaluate(there.curve, i / 50.0), evaluate(back.curve, 1.0 - i / 50.0)), 1e-6);
}

TEST(SplineFit, KnotsByTheParametersFollowTheCourseToo) {
  const auto points = noisy_course(0.25, 0.02, 8);
  EXPECT_LT(error_of(fit_spline(points, {.knots = KnotPlacement::kAveraged}).value().curve), 0.01);
}

TEST(SplineFit, AWeightOfZeroLeavesThePointOut) {
  auto points = noisy_course(0.25, 0.0, 0);
  std::vector<double> weights(points.size(), 1.0);
  points[40] = points[40] + Vec2{0.0, 0.3};
  weights[40] = 0.0;
  const auto fit = fit_spline(points, {}, weights).value();
  EXPECT_LT(error_of(fit.curve), 0.006);
  EXPECT_LT(fit.residuals.p95_m, 0.02);
  EXPECT_GT(fit.residuals.signed_m[40], 0.25);
}

TEST(SplineFit, EndsAtTheOutermostPointsThatWeighAnything) {
  std::vector<Vec2> points;
  for (int i = 0; i <= 40; ++i) points.push_back({0.5 * i, 1.0});
  std::vector<double> weights(points.size(), 1.0);
  for (const std::size_t i : {0U, 1U, 39U, 40U}) weights[i] = 0.0;
  const auto fit = fit_spline(points, {}, weights).value();
  EXPECT_LT(distance(evaluate(fit.curve, 0.0), {1.0, 1.0}), 1e-6);
  EXPECT_LT(distance(evaluate(fit.curve, 1.0), {19.0, 1.0}), 1e-6);
}

}  // namespace
}  // namespace verge::fit
