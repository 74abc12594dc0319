// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/fit/bspline.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "verge/core/polyline.hpp"
#include "verge/fit/knots.hpp"

namespace verge::fit {
namespace {

/// De Boor's algorithm on control points: repeated interpolation, no basis function in sight.
Vec2 de_boor(const BSpline& c, double u) {
  std::size_t k = c.degree;
  while (k + 1 < c.control_points.size() && c.knots[k + 1] <= u) ++k;
  std::vector<Vec2> d(c.control_points.begin() + static_cast<std::ptrdiff_t>(k - c.degree),
                      c.control_points.begin() + static_cast<std::ptrdiff_t>(k + 1));
  for (std::size_t r = 1; r <= c.degree; ++r) {
    for (std::size_t j = c.degree; j >= r; --j) {
      const double from = c.knots[j + k - c.degree];
      const double to = c.knots[j + 1 + k - r];
      const double a = (u - from) / (to - from);
      d[j] = (1.0 - a) * d[j - 1] + a * d[j];
    }
  }
  return d.back();
}

using Raw = std::vector<std::pair<std::uint8_t, std::int8_t>>;

/// A clamped curve of the given degree with uneven knots, from whatever the generator gave.
BSpline curve_of(const Raw& raw, std::size_t degree) {
  BSpline curve{.degree = degree, .knots = std::vector<double>(degree + 1, 0.0), .control_points = {}};
  double t = 0.0;
  for (std::size_t i = 0; i < raw.size(); ++i) {
    curve.control_points.push_back({static_cast<double>(i), raw[i].second / 16.0});
    if (i >= degree) t += 0.1 + raw[i].first / 64.0;
    if (i >= degree && i + 1 < raw.size()) curve.knots.push_back(t);
  }
  curve.knots.insert(curve.knots.end(), degree + 1, t);
  return curve;
}

BSpline bezier(std::vector<Vec2> control) { return {3, uniform_knots(4, 3), std::move(control)}; }

/// A quarter of a circle of radius 10 m as a cubic Bezier arc, good to 3e-4 of the radius.
BSpline quarter_circle() {
  const double h = 10.0 * 4.0 / 3.0 * (std::numbers::sqrt2 - 1.0);
  return bezier({{10.0, 0.0}, {10.0, h}, {h, 10.0}, {0.0, 10.0}});
}

TEST(Basis, OfOrderOneIsOneOnItsSpanAndTheLastSpanIsClosed) {
  const std::vector<double> t{0.0, 0.0, 1.0, 2.0, 2.0};
  EXPECT_EQ(basis(t, 0, 1, 0.0), 0.0);
  EXPECT_EQ(basis(t, 1, 1, 0.0), 1.0);
  EXPECT_EQ(basis(t, 1, 1, 1.0), 0.0);
  EXPECT_EQ(basis(t, 2, 1, 1.0), 1.0);
  EXPECT_EQ(basis(t, 2, 1, 2.0), 1.0);
  EXPECT_EQ(basis(t, 3, 1, 2.0), 0.0);
}

TEST(Basis, OfOrderTwoIsTheHatFunction) {
  const std::vector<double> t{0.0, 1.0, 3.0};
  EXPECT_DOUBLE_EQ(basis(t, 0, 2, 0.25), 0.25);
  EXPECT_DOUBLE_EQ(basis(t, 0, 2, 1.0), 1.0);
  EXPECT_DOUBLE_EQ(basis(t, 0, 2, 2.0), 0.5);
  EXPECT_DOUBLE_EQ(basis(t, 0, 2, 3.5), 0.0);
}

TEST(Basis, OfOrderFourOnUniformKnotsIsThePaper3Matrix) {
  std::vector<double> t;
  for (int i = 0; i < 8; ++i) t.push_back(i);
  for (const double u : {0.0, 0.125, 0.5, 0.9}) {
    const auto weights = uniform_cubic_weights(u);
    for (std::size_t j = 0; j < 4; ++j) EXPECT_NEAR(basis(t, j, 4, 3.0 + u), weights[j], 1e-15);
  }
}

TEST(Basis, OnClampedKnotsWithoutInteriorAreTheBernsteinPolynomials) {
  const auto t = uniform_knots(4, 3);
  for (const double u : {0.0, 0.3, 1.0}) {
    EXPECT_NEAR(basis(t, 0, 4, u), (1 - u) * (1 - u) * (1 - u), 1e-15);
    EXPECT_NEAR(basis(t, 1, 4, u), 3 * u * (1 - u) * (1 - u), 1e-15);
    EXPECT_NEAR(basis(t, 2, 4, u), 3 * u * u * (1 - u), 1e-15);
    EXPECT_NEAR(basis(t, 3, 4, u), u * u * u, 1e-15);
  }
}

TEST(Basis, SumsToOneIsNotNegativeAndTheRowHoldsAllThatIsNotZero) {
  rc::check([](const Raw& raw, std::uint16_t where) {
    const auto degree = *rc::gen::inRange<std::size_t>(0, kMaxDegree + 1);
    RC_PRE(raw.size() > degree);
    const auto t = curve_of(raw, degree).knots;
    const double u = t.back() * (where / 65535.0);
    const BasisRow row = basis_row(t, degree, u);
    double sum = 0.0;
    for (std::size_t i = 0; i < raw.size(); ++i) {
      const double value = basis(t, i, degree + 1, u);
      RC_ASSERT(value >= 0.0);
      const bool in_row = i >= row.first && i <= row.first + degree;
      RC_ASSERT(std::abs(value - (in_row ? row.values[i - row.first] : 0.0)) < 1e-14);
      sum += value;
    }
    RC_ASSERT(std::abs(sum - 1.0) < 1e-13);
  });
}

TEST(UniformCubic, WeightsOfTheCorrectedMatrixSumToOne) {
  for (int i = 0; i <= 16; ++i) {
    const auto w = uniform_cubic_weights(i / 16.0);
    EXPECT_NEAR(w[0] + w[1] + w[2] + w[3], 1.0, 1e-15);
  }
}

TEST(UniformCubic, WeightsOfThePrintedMatrixSumToFiveSixthsForEveryU) {
  for (int i = 0; i <= 16; ++i) {
    const auto w = uniform_cubic_weights(i / 16.0, MatrixRow::kPrinted);
    EXPECT_NEAR(w[0] + w[1] + w[2] + w[3], 5.0 / 6.0, 1e-15);
  }
}

TEST(UniformCubic, EquationThreeAtTheJointIsOneFourOneSixths) {
  const std::array<Vec2, 4> p{{{0.0, 6.0}, {6.0, 12.0}, {12.0, 0.0}, {18.0, 6.0}}};
  EXPECT_EQ(uniform_cubic(p, 0.0), (Vec2{6.0, 9.0}));
  EXPECT_EQ(uniform_cubic(p, 1.0), (Vec2{12.0, 3.0}));
  EXPECT_EQ(uniform_cubic(p, 0.0, MatrixRow::kPrinted), (Vec2{6.0, 8.0}));
}

TEST(UniformCubic, MovingThePointsMovesTheCorrectedCurveAndNotThePrintedOne) {
  const std::array<Vec2, 4> p{{{0.0, 0.0}, {1.0, 2.0}, {2.0, 1.0}, {3.0, 3.0}}};
  std::array<Vec2, 4> moved = p;
  for (Vec2& q : moved) q = q + Vec2{60.0, 0.0};
  const auto shift = [&](MatrixRow row) {
    return uniform_cubic(moved, 0.4, row).x - uniform_cubic(p, 0.4, row).x;
  };
  EXPECT_NEAR(shift(MatrixRow::kCorrected), 60.0, 1e-12);
  EXPECT_NEAR(shift(MatrixRow::kPrinted), 50.0, 1e-12);
}

TEST(BSpline, WithoutInteriorKnotsIsTheBezierCurve) {
  const std::vector<Vec2> p{{0.0, 0.0}, {1.0, 3.0}, {4.0, 3.0}, {5.0, 0.0}};
  const Vec2 middle = evaluate(bezier(p), 0.5);
  EXPECT_DOUBLE_EQ(middle.x, (0.0 + 3.0 * 1.0 + 3.0 * 4.0 + 5.0) / 8.0);
  EXPECT_DOUBLE_EQ(middle.y, (3.0 * 3.0 + 3.0 * 3.0) / 8.0);
}

TEST(BSpline, ClampedRunsFromItsFirstToItsLastControlPoint) {
  const BSpline curve = curve_of({{9, 3}, {0, -40}, {77, 5}, {200, 90}, {3, 12}, {1, 7}}, 3);
  EXPECT_EQ(evaluate(curve, 0.0), curve.control_points.front());
  EXPECT_EQ(evaluate(curve, curve.knots.back()), curve.control_points.back());
  EXPECT_EQ(evaluate(curve, -5.0), curve.control_points.front());
  EXPECT_EQ(evaluate(curve, 1e9), curve.control_points.back());
}

TEST(BSpline, WhoseLastSpansAreEmptyStillHasItsEndPoint) {
  const BSpline curve{.degree = 2,
                      .knots = {0.0, 0.0, 0.0, 0.5, 1.0, 1.0, 1.0, 1.0},
                      .control_points = {{0.0, 0.0}, {1.0, 1.0}, {2.0, 0.0}, {3.0, 5.0}, {9.0, 9.0}}};
  EXPECT_EQ(evaluate(curve, 1.0), (Vec2{3.0, 5.0}));  // the control point after it has no span to act on
}

TEST(BSpline, AgreesWithDeBoorsAlgorithm) {
  rc::check([](const Raw& raw, std::uint16_t where) {
    const auto degree = *rc::gen::inRange<std::size_t>(1, kMaxDegree + 1);
    RC_PRE(raw.size() > degree);
    const BSpline curve = curve_of(raw, degree);
    const double u = curve.knots.back() * (where / 65536.0);
    RC_ASSERT(distance(evaluate(curve, u), de_boor(curve, u)) < 1e-11);
  });
}

TEST(BSpline, OfAnAffineImageIsTheAffineImage) {
  rc::check([](const Raw& raw, std::uint16_t where) {
    RC_PRE(raw.size() > 3U);
    BSpline curve = curve_of(raw, 3);
    const auto image = [](Vec2 p) { return Vec2{2.0 * p.x - 3.0 * p.y + 7.0, 0.5 * p.x + 4.0 * p.y - 1.0}; };
    const double u = curve.knots.back() * (where / 65535.0);
    const Vec2 before = evaluate(curve, u);
    for (Vec2& p : curve.control_points) p = image(p);
    RC_ASSERT(distance(evaluate(curve, u), image(before)) < 1e-10);
  });
}

TEST(BSpline, ReversedRunsTheSameWayBack) {
  rc::check([](const Raw& raw, std::uint16_t where) {
    RC_PRE(raw.size() > 3U);
    const BSpline curve = curve_of(raw, 3);
    BSpline back = curve;
    std::ranges::reverse(back.control_points);
    std::ranges::reverse(back.knots);
    for (double& t : back.knots) t = curve.knots.back() - t;
    const double u = curve.knots.back() * (where / 65535.0);
    RC_ASSERT(distance(evaluate(back, curve.knots.back() - u), evaluate(curve, u)) < 1e-9);
  });
}

TEST(BSpline, DerivativeOfABezierCurveIsThreeTimesItsDifferences) {
  const BSpline tangent = derivative(bezier({{0.0, 0.0}, {1.0, 3.0}, {4.0, 3.0}, {5.0, 0.0}}));
  EXPECT_EQ(tangent.degree, 2U);
  EXPECT_EQ(evaluate(tangent, 0.0), (Vec2{3.0, 9.0}));
  EXPECT_EQ(evaluate(tangent, 1.0), (Vec2{3.0, -9.0}));
}

TEST(BSpline, DerivativeIsTheLimitOfDifferences) {
  rc::check([](const Raw& raw, std::uint16_t where) {
    RC_PRE(raw.size() > 3U);
    const BSpline curve = curve_of(raw, 3);
    constexpr double kStep = 1e-6;
    const double u = kStep + (curve.knots.back() - 2.0 * kStep) * (where / 65535.0);
    const Vec2 difference = (0.5 / kStep) * (evaluate(curve, u + kStep) - evaluate(curve, u - kStep));
    const Vec2 exact = evaluate(derivative(curve), u);
    RC_ASSERT(distance(difference, exact) < 2e-4 * (1.0 + norm(exact)));
  });
}

TEST(BSpline, LengthOfAQuarterCircleIsHalfPiRadii) {
  EXPECT_NEAR(length(quarter_circle()), 5.0 * std::numbers::pi, 5e-3);
}

TEST(BSpline, ArcLengthsGrowFromZeroToTheLength) {
  const BSpline curve = quarter_circle();
  const auto s = arc_lengths(curve, std::vector<double>{0.0, 0.5, 1.0});
  EXPECT_EQ(s[0], 0.0);
  EXPECT_NEAR(s[1], 2.5 * std::numbers::pi, 3e-3);
  EXPECT_DOUBLE_EQ(s[2], length(curve));
}

TEST(BSpline, SamplesLieOnTheCurveAndAreEvenlySpaced) {
  const auto points = sample(quarter_circle(), 0.5);
  ASSERT_EQ(points.size(), 33U);  // 15.708 m in 32 steps of 0.491 m
  EXPECT_EQ(points.front(), (Vec2{10.0, 0.0}));
  EXPECT_EQ(points.back(), (Vec2{0.0, 10.0}));
  for (std::size_t i = 1; i < points.size(); ++i) {
    EXPECT_NEAR(norm(points[i]), 10.0, 3e-3);
    EXPECT_NEAR(distance(points[i - 1], points[i]), 5.0 * std::numbers::pi / 32.0, 5e-3);
  }
}

TEST(BSpline, SamplesOfAStraightCurveAreEvenToo) {
  // Control points crowd at the start: the parameter is not the length.
  const auto points = sample(bezier({{0.0, 0.0}, {0.1, 0.0}, {0.2, 0.0}, {10.0, 0.0}}), 1.0);
  ASSERT_EQ(points.size(), 11U);
  for (std::size_t i = 0; i < points.size(); ++i) EXPECT_NEAR(points[i].x, static_cast<double>(i), 0.02);
}

TEST(BSpline, ACurveWithoutLengthHasOneSample) {
  EXPECT_EQ(sample(bezier(std::vector<Vec2>(4, Vec2{1.0, 2.0})), 0.5), (std::vector<Vec2>{{1.0, 2.0}}));
}

TEST(BSpline, NearestParametersGiveTheFootOfEachPoint) {
  const BSpline curve = quarter_circle();
  std::vector<Vec2> points;
  std::vector<Vec2> feet;
  for (int i = 1; i < 20; ++i) {
    const double angle = 0.5 * std::numbers::pi * i / 20.0;
    points.push_back((i % 2 == 0 ? 8.0 : 13.0) * Vec2{std::cos(angle), std::sin(angle)});
    feet.push_back(10.0 * Vec2{std::cos(angle), std::sin(angle)});
  }
  const auto u = nearest_parameters(curve, points);
  for (std::size_t i = 0; i < u.size(); ++i) EXPECT_LT(distance(evaluate(curve, u[i]), feet[i]), 0.01);
}

/// How far the curve strays from a polyline of 16 chords a span, about.
double greatest_sagitta(const BSpline& curve) {
  double greatest = 0.0;
  for (std::size_t k = curve.degree; k + 1 + curve.degree < curve.knots.size(); ++k) {
    const double h = (curve.knots[k + 1] - curve.knots[k]) / 16.0;
    for (int i = 0; i < 16; ++i) {
      const double u = curve.knots[k] + i * h;
      const Vec2 chord_middle = 0.5 * (evaluate(curve, u) + evaluate(curve, u + h));
      greatest = std::max(greatest, distance(evaluate(curve, u + 0.5 * h), chord_middle));
    }
  }
  return greatest;
}

TEST(BSpline, NoPointOfTheCurveIsNearerThanTheFoot) {
  rc::check([](const Raw& raw, std::int16_t x, std::int16_t y) {
    RC_PRE(raw.size() > 3U);
    const BSpline curve = curve_of(raw, 3);
    const Vec2 p{x / 1024.0, y / 1024.0};
    const double u = nearest_parameters(curve, std::vector<Vec2>{p}).front();
    const double found = distance(evaluate(curve, u), p);
    const double slack = 1.5 * greatest_sagitta(curve);
    for (int i = 0; i <= 500; ++i)
      RC_ASSERT(found <= distance(evaluate(curve, curve.knots.back() * i / 500.0), p) + slack);
  });
}

TEST(BSpline, PointsBeyondTheEndsHaveTheEndsAsFeet) {
  const BSpline curve = bezier({{0.0, 0.0}, {1.0, 0.0}, {2.0, 0.0}, {3.0, 0.0}});
  EXPECT_EQ(nearest_parameters(curve, std::vector<Vec2>{{-4.0, 1.0}, {9.0, 1.0}}),
            (std::vector<double>{0.0, 1.0}));
}

}  // namespace
}  // namespace verge::fit
