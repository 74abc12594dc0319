// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/fit/polynomial.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <random>
#include <span>
#include <vector>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "verge/fit/test_clusters.hpp"
#include "verge/fit/test_points.hpp"

namespace verge::fit {
namespace {

std::vector<Vec2> on_curve(const std::function<double(double)>& y, int count) {
  std::vector<Vec2> points;
  for (int i = 0; i < count; ++i) points.push_back({5.0 + 0.25 * i, y(5.0 + 0.25 * i)});
  return points;
}

/// How far the curve leaves the range of the points' y, metres, looked at every thousandth of their extent.
double overshoot(const Polynomial& curve, const std::vector<Vec2>& points) {
  const auto [low, high] = std::ranges::minmax(points, {}, &Vec2::y);
  double most = 0.0;
  for (int i = 0; i <= 1000; ++i) {
    const double y = value_at(curve, curve.middle_m + curve.half_m * (i / 500.0 - 1.0));
    most = std::max({most, y - high.y, low.y - y});
  }
  return most;
}

double rms_at(const Polynomial& curve, const std::vector<Vec2>& points) {
  double squares = 0.0;
  for (const Vec2 p : points) squares += std::pow(p.y - value_at(curve, p.x), 2);
  return std::sqrt(squares / static_cast<double>(points.size()));
}

TEST(Polynomial, GoesThroughOnePointMoreThanItsDegree) {
  const std::vector<Vec2> points{{10.0, 3.0}, {11.0, -1.0}, {13.0, 4.0}, {14.5, 4.0}};
  const auto fit = fit_polynomial(points, 3).value();
  for (const Vec2 p : points) EXPECT_NEAR(value_at(fit.curve, p.x), p.y, 1e-12);
}

TEST(Polynomial, HasTheCoefficientsOfThePapersFormula) {
  const auto fit =
      fit_polynomial(on_curve([](double x) { return 2.0 * x * x - 3.0 * x + 1.0; }, 20), 2).value();
  const auto p = power_coefficients(fit.curve);  // y = p_1 x^2 + p_2 x + p_3
  ASSERT_EQ(p.size(), 3U);
  EXPECT_NEAR(p[0], 2.0, 1e-10);
  EXPECT_NEAR(p[1], -3.0, 1e-10);
  EXPECT_NEAR(p[2], 1.0, 1e-10);
  EXPECT_EQ(power_coefficients({.middle_m = 4.0, .half_m = 2.0, .chebyshev_m = {7.0}}),
            std::vector<double>{7.0});
}

TEST(Polynomial, ResidualsAreAlongYAndPositiveAbove) {
  const auto fit =
      fit_polynomial(std::vector<Vec2>{{0.0, 0.0}, {1.0, 2.0}, {2.0, 2.0}, {3.0, 4.0}}, 1).value();
  EXPECT_NEAR(value_at(fit.curve, 0.0), 0.2, 1e-12);  // y = 0.2 + 1.2 x
  EXPECT_NEAR(fit.residuals.signed_m[0], -0.2, 1e-12);
  EXPECT_NEAR(fit.residuals.signed_m[1], 0.6, 1e-12);
  EXPECT_NEAR(fit.residuals.rms_m, std::sqrt(0.2), 1e-12);
}

TEST(Polynomial, WithoutTwoDistinctXThereIsNone) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  const std::vector<std::vector<Vec2>> degenerate{
      {}, {{1.0, 2.0}}, {{1.0, 2.0}, {1.0, 3.0}, {1.0, 4.0}}, {{0.0, 0.0}, {1.0, kNan}, {2.0, 1.0}}};
  for (const auto& points : degenerate) {
    EXPECT_FALSE(fit_polynomial(points, 3));
    EXPECT_FALSE(fit_polynomial_to(points));
    for (const auto reading : {StatedError::kNone, StatedError::kJitter, StatedError::kRidge,
                               StatedError::kSigma, StatedError::kGate})
      EXPECT_FALSE(fit_polynomial_with(points, {.reading = reading, .jitter = 0.0}));
  }
  EXPECT_FALSE(fit_polynomial(std::vector<Vec2>{{0.0, 0.0}, {1.0, 0.0}}, 1, std::vector<double>{1.0, 0.0}));
}

TEST(Polynomial, FourteenPointsCarryDegreeThirteenAndNotThePapersSixteen) {
  const auto points = testing::figure_12();
  const auto fit = fit_polynomial(points, 16).value();
  EXPECT_EQ(fit.curve.degree(), 13U);
  EXPECT_LT(fit.residuals.rms_m, 0.01);  // 4e-4: so badly do these points tell it
}

TEST(Polynomial, RepeatedXCarryNoMoreThanTheyDoOnce) {
  std::vector<Vec2> points;
  for (int i = 0; i < 30; ++i) points.push_back({static_cast<double>(i % 5), 0.1 * i});
  const auto fit = fit_polynomial(points, 16).value();
  EXPECT_EQ(fit.curve.degree(), 4U);
  EXPECT_NEAR(value_at(fit.curve, 2.0), 0.1 * (2 + 7 + 12 + 17 + 22 + 27) / 6.0, 1e-12);  // the mean there
}

TEST(Polynomial, ToAToleranceTakesTheLeastDegreeThatIsCloseEnough) {
  const auto cubic = on_curve([](double x) { return 0.01 * std::pow(x - 9.0, 3); }, 40);
  EXPECT_EQ(fit_polynomial_to(cubic).value().curve.degree(), 3U);
  const auto wave = on_curve([](double x) { return std::sin(x); }, 60);
  const auto fit = fit_polynomial_to(wave).value();
  const std::size_t degree = fit.curve.degree();
  EXPECT_LE(fit.residuals.rms_m, 1e-3);  // half of the extent is 1 m, to within 1 %
  EXPECT_GT(fit_polynomial(wave, degree - 1).value().residuals.rms_m, 1e-3);
  EXPECT_LT(degree, 16U);
  EXPECT_EQ(fit_polynomial_to(wave, 0.5).value().curve.degree(), 5U);
  EXPECT_EQ(fit_polynomial_to(wave, 1e-3, 4).value().curve.degree(), 4U);  // the tolerance is out of reach
}

TEST(Polynomial, OfAToleranceIsThatOfItsDegree) {
  const auto edge = testing::straight_edge(60, 1);
  const auto to = fit_polynomial_to(edge).value();
  EXPECT_EQ(to.curve.degree(), 16U);  // 3 cm of noise are 2 % of half of the extent
  const auto plain = fit_polynomial(edge, 16).value();
  for (std::size_t k = 0; k <= 16; ++k)
    EXPECT_NEAR(to.curve.chebyshev_m[k], plain.curve.chebyshev_m[k], 1e-12);
  EXPECT_EQ(fit_polynomial_to(edge, 0.03).value().curve.degree(), 1U);
}

TEST(Polynomial, DegreeSixteenIsNoBetterOnAStraightEdgeThanALine) {
  std::vector<double> held_out(17, 0.0);
  constexpr std::uint32_t kEdges = 50;
  for (std::uint32_t seed = 0; seed < kEdges; ++seed) {
    const auto seen = testing::straight_edge(60, seed);
    const auto others = testing::straight_edge(60, kEdges + seed);
    for (const std::size_t degree : {1U, 2U, 3U, 16U})
      held_out[degree] += rms_at(fit_polynomial(seen, degree).value().curve, others) / kEdges;
  }
  EXPECT_LT(held_out[1], held_out[2]);
  EXPECT_LT(held_out[2], held_out[3]);
  EXPECT_GT(held_out[16], 1.1 * held_out[1]);
}

TEST(Polynomial, DegreeSixteenOvershootsOnACarAndARidgeTamesIt) {
  const auto with_ridge = [](const std::vector<Vec2>& car, double ridge) {
    return overshoot(fit_polynomial_with(car, {.reading = StatedError::kRidge, .ridge = ridge}).value().curve,
                     car);
  };
  for (std::uint32_t seed = 1; seed <= 10; ++seed) {
    const auto car = testing::l_shaped_car(0.25, seed);
    const double plain = overshoot(fit_polynomial(car, 16).value().curve, car);
    EXPECT_GT(plain, with_ridge(car, 1e-3));
    EXPECT_GT(with_ridge(car, 1e-3), with_ridge(car, 1.0));
    if (seed != 3) continue;
    EXPECT_NEAR(plain, 8.8, 0.1);
    EXPECT_NEAR(with_ridge(car, 1e-3), 4.1, 0.1);
    EXPECT_NEAR(with_ridge(car, 1.0), 0.16, 0.01);
  }
}

TEST(Polynomial, DegreeSixteenFollowsACarsOwnPointsAndNoOthers) {
  const auto car = testing::l_shaped_car(0.5, 1);
  const auto again = testing::l_shaped_car(0.5, 2);
  const auto two = fit_polynomial(car, 2).value().curve;
  const auto sixteen = fit_polynomial(car, 16).value().curve;
  EXPECT_LT(rms_at(sixteen, car), rms_at(two, car));
  EXPECT_NEAR(rms_at(two, again), 0.5, 0.05);
  EXPECT_GT(rms_at(sixteen, again), 1e6);
}

TEST(Polynomial, ARidgeMakesRepeatedXSolvableAndKeepsTheMean) {
  std::vector<Vec2> points;
  for (int i = 0; i < 30; ++i) points.push_back({static_cast<double>(i % 5), 3.0});
  const auto fit = fit_polynomial_with(points, {.reading = StatedError::kRidge, .ridge = 1e3}).value();
  EXPECT_EQ(fit.curve.degree(), 16U);
  EXPECT_NEAR(value_at(fit.curve, 2.5), 3.0, 1e-12);
}

TEST(Polynomial, JitterMakesRepeatedXDistinctAndTheCurveWild) {
  std::vector<Vec2> points;
  for (int i = 0; i < 39; ++i) points.push_back({static_cast<double>(i % 13), 0.01 * (i * i % 7)});
  EXPECT_EQ(fit_polynomial(points, 16).value().curve.degree(), 12U);
  const auto fit = fit_polynomial_with(points, {.reading = StatedError::kJitter}).value();
  EXPECT_EQ(fit.curve.degree(), 16U);
  EXPECT_NE(
      fit.curve.chebyshev_m,
      fit_polynomial_with(points, {.reading = StatedError::kJitter, .seed = 1}).value().curve.chebyshev_m);
}

TEST(Polynomial, OneDeviationForAllChangesNothing) {
  const auto edge = testing::straight_edge(60, 1);
  const auto plain = fit_polynomial(edge, 16).value();
  const auto weighted =
      fit_polynomial_with(edge, {.reading = StatedError::kSigma, .sigma_m = 1000.0}).value();
  for (std::size_t k = 0; k <= 16; ++k)
    EXPECT_NEAR(weighted.curve.chebyshev_m[k], plain.curve.chebyshev_m[k], 1e-12);
  EXPECT_NEAR(weighted.residuals.rms_m, plain.residuals.rms_m, 1e-12);
}

TEST(Polynomial, AGateLeavesOutWhatIsFartherThanAMetre) {
  auto points = testing::straight_edge(60, 1);
  for (std::size_t i = 0; i < 60; i += 6) points[i].y += 4.0;  // at first they draw the line up by 0.7 m
  const auto fit = fit_polynomial_with(points, {.reading = StatedError::kGate, .degree = 1}).value();
  for (std::size_t i = 0; i < 60; ++i) EXPECT_EQ(fit.weights[i], i % 6 == 0 ? 0.0 : 1.0);
  EXPECT_LT(fit.residuals.rms_m, 0.04);
  EXPECT_GT(fit_polynomial(points, 1).value().residuals.rms_m, 1.0);
  const auto wide = fit_polynomial_with(points, {.reading = StatedError::kGate, .degree = 1, .gate_m = 9.0});
  EXPECT_EQ(wide.value().curve.chebyshev_m, fit_polynomial(points, 1).value().curve.chebyshev_m);
}

TEST(Polynomial, NoOtherOfItsDegreeIsNearerInTheSumOfSquares) {
  rc::check([](const testing::RawSteps& raw, std::uint8_t degree) {
    const auto points = testing::steps_of(raw);
    const auto fit = fit_polynomial(points, degree % 7);
    RC_PRE(fit.has_value());
    for (std::size_t k = 0; k <= fit->curve.degree(); ++k) {  // residuals are orthogonal to every column
      Polynomial column = fit->curve;
      std::ranges::fill(column.chebyshev_m, 0.0);
      column.chebyshev_m[k] = 1.0;
      double product = 0.0;
      double length = 0.0;
      for (std::size_t i = 0; i < points.size(); ++i) {
        product += fit->residuals.signed_m[i] * value_at(column, points[i].x);
        length += std::abs(fit->residuals.signed_m[i]);
      }
      RC_ASSERT(std::abs(product) <= 1e-9 * (1.0 + length));
    }
  });
}

TEST(Polynomial, FollowsItsPoints) {
  rc::check([](const testing::RawSteps& raw) {
    const auto points = testing::steps_of(raw);
    const auto fit = fit_polynomial(points, 4);
    RC_PRE(fit.has_value());
    const auto rms_after = [&](auto moved) {
      std::vector<Vec2> others;
      for (const Vec2 p : points) others.push_back(moved(p));
      std::ranges::reverse(others);
      return fit_polynomial(others, 4).value().residuals.rms_m;
    };
    const double rms = fit->residuals.rms_m;
    RC_ASSERT(std::abs(rms_after([](Vec2 p) { return p; }) - rms) < 1e-9);
    RC_ASSERT(std::abs(rms_after([](Vec2 p) { return p + Vec2{-300.0, 40.0}; }) - rms) < 1e-9);
    RC_ASSERT(std::abs(rms_after([](Vec2 p) { return Vec2{-p.x, p.y}; }) - rms) < 1e-9);
    RC_ASSERT(std::abs(rms_after([](Vec2 p) { return Vec2{p.x, -p.y}; }) - rms) < 1e-9);
    RC_ASSERT(std::abs(rms_after([](Vec2 p) { return Vec2{p.x, p.y + 0.01 * p.x * p.x}; }) - rms) < 1e-6);
  });
}

TEST(Polynomial, AWeightOfTwoCountsAPointTwice) {
  const std::vector<Vec2> points{{0.0, 0.0}, {1.0, 2.0}, {2.0, 2.0}, {3.0, 4.0}, {9.0, 9.0}};
  const auto weighted = fit_polynomial(points, 1, std::vector<double>{1.0, 2.0, 1.0, 1.0, 0.0}).value();
  const auto repeated =
      fit_polynomial(std::vector<Vec2>{{0.0, 0.0}, {1.0, 2.0}, {1.0, 2.0}, {2.0, 2.0}, {3.0, 4.0}}, 1)
          .value();
  for (const double x : {0.0, 1.5, 3.0})
    EXPECT_NEAR(value_at(weighted.curve, x), value_at(repeated.curve, x), 1e-12);
  EXPECT_NEAR(weighted.residuals.rms_m, repeated.residuals.rms_m, 1e-12);
}

}  // namespace
}  // namespace verge::fit
