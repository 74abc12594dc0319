// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/fit/curvature.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>
#include <span>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace verge::fit {
namespace {

/// 15 m straight ahead, then a left-hand arc of 20 m radius over 45 degrees, a point every 0.25 m, with
/// Gaussian noise in x and y (the course of A2.2-6).
std::vector<Vec2> line_then_arc(double sigma, std::uint32_t seed) {
  std::mt19937 engine(seed);
  std::normal_distribution<double> noise(0.0, 1.0);
  std::vector<Vec2> points;
  for (int i = 0; i <= 122; ++i) {
    const double s = 0.25 * i;
    const double turn = std::max(0.0, (s - 15.0) / 20.0);
    const Vec2 on_line{std::min(s, 15.0) + 20.0 * std::sin(turn), 20.0 * (1.0 - std::cos(turn))};
    points.push_back(on_line + Vec2{sigma * noise(engine), sigma * noise(engine)});
  }
  return points;
}

std::vector<std::size_t> smoothed_keys(std::span<const Vec2> points, double window_m) {
  return smoothed_key_points(points, smoothed_curvature(points, window_m), window_m);
}

TEST(Curvature, TheCircleThroughThreePointsHasThemAllAtItsRadius) {
  const auto circle = circle_through({5.0, 2.0}, {1.0, 6.0}, {-3.0, 2.0}).value();
  EXPECT_NEAR(circle.centre.x, 1.0, 1e-14);
  EXPECT_NEAR(circle.centre.y, 2.0, 1e-14);
  EXPECT_NEAR(circle.radius_m, 4.0, 1e-14);
}

TEST(Curvature, CollinearOrCoincidingPointsHaveNoCircle) {
  EXPECT_FALSE(circle_through({0.0, 0.0}, {1.0, 1.0}, {2.0, 2.0}).has_value());
  EXPECT_FALSE(circle_through({0.0, 0.0}, {0.0, 0.0}, {2.0, 1.0}).has_value());
  EXPECT_FALSE(circle_through({0.0, 0.0}, {1.0, 1e-320}, {2.0, 0.0}).has_value());
}

TEST(Curvature, OfAnArcIsOneOverItsRadiusAndOfALineZero) {
  const auto k = curvature(line_then_arc(0.0, 0));
  EXPECT_NEAR(k[30], 0.0, 1e-9);
  EXPECT_NEAR(k[90], 1.0 / 20.0, 1e-9);
  EXPECT_EQ(k.front(), 0.0);
  EXPECT_EQ(k.back(), 0.0);
}

TEST(Curvature, OfFewerThanThreePointsIsZero) {
  EXPECT_TRUE(curvature({}).empty());
  EXPECT_EQ(curvature(std::vector<Vec2>{{0.0, 0.0}, {1.0, 0.0}}), (std::vector<double>{0.0, 0.0}));
}

TEST(Curvature, DoesNotChangeUnderTurningMovingOrReversing) {
  rc::check([](const std::vector<std::pair<std::int8_t, std::int8_t>>& raw) {
    std::vector<Vec2> points;
    std::vector<Vec2> moved;
    for (const auto& [x, y] : raw) {
      points.push_back({static_cast<double>(x), static_cast<double>(y)});
      moved.push_back({5.0 - y, static_cast<double>(x) - 3.0});  // a quarter turn: exact in floating point
    }
    std::ranges::reverse(moved);
    auto again = curvature(moved);
    std::ranges::reverse(again);
    const auto k = curvature(points);
    for (std::size_t i = 0; i < k.size(); ++i) RC_ASSERT(std::abs(k[i] - again[i]) <= 1e-9 * (1.0 + k[i]));
  });
}

TEST(KeyPoints, AreBothEndsAndThePointsAtOrAboveTheMeanCurvature) {
  // k_avg of the five points between the ends is 2.
  const std::vector<double> k{0.0, 1.0, 2.0, 4.0, 1.0, 2.0, 0.0};
  EXPECT_EQ(key_points(k), (std::vector<std::size_t>{0, 2, 3, 5, 6}));
}

TEST(KeyPoints, OfOneTwoOrNoPointsAreThoseThemselves) {
  EXPECT_TRUE(key_points({}).empty());
  EXPECT_EQ(key_points(std::vector<double>{0.0}), (std::vector<std::size_t>{0}));
  EXPECT_EQ(key_points(std::vector<double>{0.0, 0.0}), (std::vector<std::size_t>{0, 1}));
}

TEST(KeyPoints, OfAnExactCourseStandWhereItBends) {
  const auto keys = key_points(curvature(line_then_arc(0.0, 0)));
  for (const std::size_t i : keys) EXPECT_TRUE(i == 0 || i >= 60) << i;
}

TEST(KeyPoints, OfNoisyPointsAreFewerThanHalfAsThePaperSays) {
  for (std::uint32_t seed = 1; seed <= 20; ++seed) {
    const auto points = line_then_arc(0.03, seed);
    EXPECT_LT(2 * key_points(curvature(points)).size(), points.size());
  }
}

TEST(Curvature, SmoothedFindsTheArcsRadiusInNoiseThatHidesItFromThreeNeighbours) {
  const auto points = line_then_arc(0.03, 1);
  const auto smoothed = smoothed_curvature(points, 2.0);
  const auto plain = curvature(points);
  double greatest_on_line = 0.0;
  for (std::size_t i = 0; i < 52; ++i) greatest_on_line = std::max(greatest_on_line, smoothed[i]);
  EXPECT_LT(greatest_on_line, 0.02);
  for (std::size_t i = 70; i + 12 < points.size(); ++i) EXPECT_NEAR(smoothed[i], 1.0 / 20.0, 0.02);
  EXPECT_GT(*std::ranges::max_element(plain.begin(), plain.begin() + 52), 0.5);
}

TEST(Curvature, SmoothedIsZeroWhereTheWindowDoesNotFit) {
  const auto k = smoothed_curvature(line_then_arc(0.0, 0), 2.0);
  EXPECT_EQ(k[k.size() - 4], 0.0);
  EXPECT_GT(k[k.size() - 12], 0.04);
  EXPECT_TRUE(smoothed_curvature({}, 2.0).empty());
}

TEST(KeyPoints, SmoothedOnesStandOnTheBendWhereThePapersFollowTheNoise) {
  const auto share_on_the_arc = [](auto keys_of) {
    double on_arc = 0.0;
    double total = 0.0;
    for (std::uint32_t seed = 1; seed <= 20; ++seed) {
      for (const std::size_t i : keys_of(line_then_arc(0.03, seed))) {
        if (i == 0 || i == 122) continue;
        on_arc += i >= 60 ? 1.0 : 0.0;
        total += 1.0;
      }
    }
    return on_arc / total;
  };
  const double paper = share_on_the_arc([](const auto& points) { return key_points(curvature(points)); });
  const double smoothed = share_on_the_arc([](const auto& points) { return smoothed_keys(points, 2.0); });
  EXPECT_LT(paper, 0.60);  // about half of the course is arc: the noise decides
  EXPECT_GT(smoothed, 0.95);
}

TEST(KeyPoints, SmoothedOnesOfAnExactLineAreItsEnds) {
  const auto line = line_then_arc(0.0, 0);
  EXPECT_EQ(smoothed_keys(std::span(line).first(60), 2.0), (std::vector<std::size_t>{0, 59}));
}

TEST(KeyPoints, SmoothedOnesKeepTheirDistance) {
  const auto points = line_then_arc(0.03, 3);
  const auto keys = smoothed_keys(points, 2.0);
  ASSERT_GE(keys.size(), 5U);
  for (std::size_t j = 1; j < keys.size(); ++j) EXPECT_GE(keys[j] - keys[j - 1], 3U);
  EXPECT_EQ(keys.front(), 0U);
  EXPECT_EQ(keys.back(), points.size() - 1);
}

}  // namespace
}  // namespace verge::fit
