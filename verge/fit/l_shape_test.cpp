// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/fit/l_shape.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "verge/fit/line.hpp"

namespace verge::fit {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr double kQuarter = 0.5 * std::numbers::pi;

Vec2 turned(Vec2 p, double angle) {
  return {std::cos(angle) * p.x - std::sin(angle) * p.y, std::sin(angle) * p.x + std::cos(angle) * p.y};
}

/// Points every 0.1 m on the two sides of a rectangle that meet in (0, 0): `along` m of the one along +x,
/// `across` m of the other along +y; with noise, turned, and moved by `to`.
std::vector<Vec2> l_points(double along, double across, double angle, Vec2 to, double sigma,
                           std::uint32_t seed) {
  std::mt19937 engine(seed);
  std::normal_distribution<double> noise(0.0, 1.0);
  std::vector<Vec2> points;
  for (int i = 0; i <= std::lround(10.0 * along); ++i) points.push_back({0.1 * i, sigma * noise(engine)});
  for (int i = 1; i <= std::lround(10.0 * across); ++i) points.push_back({sigma * noise(engine), 0.1 * i});
  for (Vec2& p : points) p = turned(p, angle) + to;
  return points;
}

/// How far two headings of a rectangle are apart.
double apart(double a, double b) { return std::fabs(std::remainder(a - b, kQuarter)); }

double variance(const std::vector<double>& values) {
  double mean = 0.0;
  double sum = 0.0;
  for (const double v : values) mean += v / static_cast<double>(values.size());
  for (const double v : values) sum += (v - mean) * (v - mean) / static_cast<double>(values.size());
  return sum;
}

/// Algorithms 4 and 5 of the paper, written again.
double oracle_score(const std::vector<Vec2>& points, Vec2 viewer, double heading, LShapeCriterion criterion) {
  std::vector<double> c1;
  std::vector<double> c2;
  for (const Vec2 p : points) c1.push_back(turned(p, -heading).x);
  for (const Vec2 p : points) c2.push_back(turned(p, -heading).y);
  const auto side = [](const std::vector<double>& c, double from) {
    const auto [low, high] = std::ranges::minmax(c);
    return std::fabs(from - low) < std::fabs(from - high) ? low : high;
  };
  const double s1 = side(c1, turned(viewer, -heading).x);
  const double s2 = side(c2, turned(viewer, -heading).y);
  double closeness = 0.0;
  std::vector<double> e1;
  std::vector<double> e2;
  for (std::size_t k = 0; k < points.size(); ++k) {
    const double d1 = std::fabs(c1[k] - s1);
    const double d2 = std::fabs(c2[k] - s2);
    closeness += 1.0 / std::max(std::min(d1, d2), 0.03);
    (d2 < d1 ? e2 : e1).push_back(std::min(d1, d2));
  }
  return criterion == LShapeCriterion::kCloseness ? closeness : -variance(e1) - variance(e2);
}

TEST(LShape, OfExactPointsIsExact) {
  for (const double deg : {0.0, 7.3, 30.0, 45.0, 62.5, 89.9}) {
    const Vec2 to{12.0, 3.0};
    const auto points = l_points(4.0, 1.5, deg * kDegree, to, 0.0, 1);
    const auto shape = fit_l_shape(points, to - turned({5.0, 5.0}, deg * kDegree)).value();
    EXPECT_LT(apart(shape.heading_rad, deg * kDegree), 1e-6) << deg;
    EXPECT_LT(distance(shape.corner, to), 1e-6) << deg;
    EXPECT_NEAR(distance(shape.corner, shape.edges[0].end), 4.0, 1e-6);
    EXPECT_NEAR(distance(shape.corner, shape.edges[1].end), 1.5, 1e-6);
    EXPECT_EQ(shape.edges[0].points.size() + shape.edges[1].points.size(), points.size());
    EXPECT_LT(shape.edges[0].rms_m, 1e-6);
  }
}

TEST(LShape, OfNoisyPointsIsWithinHalfADegree) {
  for (const auto criterion : {LShapeCriterion::kCloseness, LShapeCriterion::kVariance}) {
    for (std::uint32_t seed = 1; seed <= 40; ++seed) {
      const double angle = 2.2 * kDegree * seed;
      const auto points = l_points(4.0, 1.5, angle, {12.0, 3.0}, 0.03, seed);
      const auto shape =
          fit_l_shape(points, Vec2{12.0, 3.0} - turned({5.0, 5.0}, angle), {.criterion = criterion});
      EXPECT_LT(apart(shape->heading_rad, angle), 0.5 * kDegree) << seed;
      EXPECT_LT(distance(shape->corner, {12.0, 3.0}), 0.03) << seed;
      EXPECT_NEAR(shape->edges[0].rms_m, 0.03, 0.01) << seed;
    }
  }
}

TEST(LShape, ItsScoreIsThatOfThePaperAndItsHeadingNearTheBestOfAll) {
  for (const auto criterion : {LShapeCriterion::kCloseness, LShapeCriterion::kVariance}) {
    for (std::uint32_t seed = 1; seed <= 10; ++seed) {
      const Vec2 viewer = Vec2{12.0, 3.0} - turned({5.0, 5.0}, 0.15 * seed);
      const auto points = l_points(3.0, 1.8, 0.15 * seed, {12.0, 3.0}, 0.03, seed);
      double best = -std::numeric_limits<double>::infinity();
      double heading = 0.0;
      for (int i = 0; i < 900; ++i) {
        const double angle = i * kQuarter / 900.0;
        const double score = oracle_score(points, viewer, angle, criterion);
        ASSERT_NEAR(l_shape_score(points, viewer, angle, {.criterion = criterion}), score, 1e-6);
        if (score > best) heading = angle;
        best = std::max(best, score);
      }
      // Least squares move on from there, by no more than the outermost points' noise had put it off.
      EXPECT_LT(apart(fit_l_shape(points, viewer, {.criterion = criterion})->heading_rad, heading),
                2.5 * kDegree);
    }
  }
}

TEST(LShape, OfASingleFaceIsItsLine) {
  for (const double deg : {3.0, 33.0, 77.0}) {
    const auto points = l_points(4.0, 0.0, deg * kDegree, {10.0, -2.0}, 0.02, 5);
    const auto shape = fit_l_shape(points, {});
    const auto line = fit_line(points)->line;
    EXPECT_LT(apart(shape->heading_rad, std::atan2(line.direction.y, line.direction.x)), 0.15 * kDegree)
        << deg;
    const auto& edges = shape->edges;
    EXPECT_GE(std::max(edges[0].points.size(), edges[1].points.size()), points.size() - 2);
  }
}

TEST(LShape, ItsCornerIsTheOneNearestToTheViewer) {
  // All four sides of a rectangle, seen from outside each corner.
  std::vector<Vec2> points;
  for (int i = 0; i <= 40; ++i) points.insert(points.end(), {{0.1 * i, 0.0}, {0.1 * i, 2.0}});
  for (int i = 1; i < 20; ++i) points.insert(points.end(), {{0.0, 0.1 * i}, {4.0, 0.1 * i}});
  for (const Vec2 corner : {Vec2{0.0, 0.0}, {4.0, 0.0}, {0.0, 2.0}, {4.0, 2.0}}) {
    const Vec2 viewer = 4.0 * (corner - Vec2{2.0, 1.0});
    const Vec2 found = l_shape_along(points, viewer, 0.0)->corner - Vec2{2.0, 1.0};
    EXPECT_GT(found.x * (corner.x - 2.0), 0.0);
    EXPECT_GT(found.y * (corner.y - 1.0), 0.0);
  }
}

TEST(LShape, OfTooFewPointsIsNone) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(fit_l_shape({}, {}).has_value());
  EXPECT_FALSE(fit_l_shape(std::vector<Vec2>{{1.0, 2.0}}, {}).has_value());
  EXPECT_FALSE(fit_l_shape(std::vector<Vec2>{{1.0, 2.0}, {1.0, 2.0}}, {}).has_value());
  EXPECT_FALSE(fit_l_shape(std::vector<Vec2>{{1.0, 2.0}, {nan, 2.0}}, {}).has_value());
  EXPECT_FALSE(l_shape_along(std::vector<Vec2>{{1.0, 2.0}}, {}, 0.0).has_value());
  EXPECT_TRUE(fit_l_shape(std::vector<Vec2>{{1.0, 2.0}, {2.0, 2.0}}, {}).has_value());
}

RC_GTEST_PROP(LShapeLaw, TurnsMovesAndMirrorsWithItsPointsInAnyOrder, (std::uint32_t seed)) {
  const double angle = *rc::gen::inRange(-314, 314) * 0.01;
  const Vec2 by{static_cast<double>(*rc::gen::inRange(-50, 50)),
                static_cast<double>(*rc::gen::inRange(-50, 50))};
  const bool mirror = *rc::gen::arbitrary<bool>();
  const auto moved = [&](Vec2 p) { return turned({p.x, mirror ? -p.y : p.y}, angle) + by; };
  std::vector<Vec2> points = l_points(3.5, 1.6, 0.3, {9.0, 4.0}, 0.02, seed);
  const Vec2 viewer = Vec2{9.0, 4.0} - turned({6.0, 7.0}, 0.3);
  const auto plain = fit_l_shape(points, viewer).value();
  std::mt19937 engine(seed);
  std::ranges::shuffle(points, engine);
  for (Vec2& p : points) p = moved(p);
  const auto other = fit_l_shape(points, moved(viewer)).value();
  // The search's grid does not turn with the points; what least squares make of it does.
  RC_ASSERT(apart(other.heading_rad, (mirror ? -1.0 : 1.0) * plain.heading_rad + angle) < 0.2 * kDegree);
  RC_ASSERT(distance(other.corner, moved(plain.corner)) < 0.02);
}

}  // namespace
}  // namespace verge::fit
