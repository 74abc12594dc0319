// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/cluster/silhouette.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "verge/core/random.hpp"

namespace verge::cluster {
namespace {

/// Points that fill squares of 2 m about the given middles, 30 each.
std::vector<Vec2> squares_about(const std::vector<Vec2>& middles, std::uint64_t seed) {
  RandomSequence random(seed);
  std::vector<Vec2> points;
  for (const Vec2 m : middles) {
    for (int i = 0; i < 30; ++i)
      points.push_back(m + Vec2{2.0 * random.uniform() - 1.0, 2.0 * random.uniform() - 1.0});
  }
  return points;
}

/// n points evenly along x from 0 to 1.
std::vector<Vec2> straight(int n) {
  std::vector<Vec2> points;
  for (int i = 0; i < n; ++i) points.push_back({(i + 0.5) / n, 0.0});
  return points;
}

TEST(Silhouette, OfTwoPairsIsWorkedOutByHand) {
  const std::vector<Vec2> points{{0.0, 0.0}, {1.0, 0.0}, {4.0, 0.0}, {5.0, 0.0}};
  // Outer points: a = 1, b = 4.5; inner points: a = 1, b = 3.5.
  const double expected = (2.0 * (3.5 / 4.5) + 2.0 * (2.5 / 3.5)) / 4.0;
  EXPECT_DOUBLE_EQ(silhouette(points, std::vector<std::size_t>{0, 0, 1, 1}, 2), expected);
  EXPECT_DOUBLE_EQ(silhouette(points, std::vector<std::size_t>{2, 2, 0, 0}, 3),
                   expected);  // one without points
  EXPECT_LT(silhouette(points, std::vector<std::size_t>{0, 1, 0, 1}, 2), 0.0);
}

TEST(Silhouette, IsZeroWhereThereIsNothingToTellApart) {
  EXPECT_EQ(silhouette({}, {}, 2), 0.0);
  EXPECT_EQ(silhouette(straight(3), std::vector<std::size_t>{1, 1, 1}, 2), 0.0);
  EXPECT_EQ(silhouette(straight(2), std::vector<std::size_t>{0, 1}, 2), 0.0);  // each is alone
  EXPECT_EQ(silhouette(std::vector<Vec2>(4), std::vector<std::size_t>{0, 0, 1, 1}, 2), 0.0);
}

TEST(Silhouette, OfAStraightEdgeCutInItsMiddleIsBelowTheThreshold) {
  std::vector<std::size_t> label(2000, 0);
  std::fill(label.begin() + 1000, label.end(), 1);
  EXPECT_NEAR(silhouette(straight(2000), label, 2), 2.0 - 1.25 * std::log(3.0), 1e-3);  // 0.6267
  EXPECT_LT(2.0 - 1.25 * std::log(3.0), ChooseOptions{}.least_silhouette);
}

TEST(ChooseK, FindsHowManySeparateThingsThereAre) {
  const std::vector<Vec2> middles{{0.0, 0.0}, {10.0, 0.0}, {0.0, 10.0}, {10.0, 10.0}, {20.0, 5.0}};
  for (std::size_t k = 1; k <= middles.size(); ++k) {
    const auto points = squares_about({middles.begin(), middles.begin() + static_cast<std::ptrdiff_t>(k)}, k);
    const auto chosen = choose_k(points, 6);
    EXPECT_EQ(chosen.clusters.centres.size(), k);
    for (std::size_t i = 0; i < points.size(); ++i)
      EXPECT_EQ(chosen.clusters.label[i], chosen.clusters.label[i / 30 * 30]);
    EXPECT_EQ(chosen.silhouettes.size(), 5U);
  }
}

TEST(ChooseK, KeepsAStraightEdgeInOnePiece) {
  const auto chosen = choose_k(straight(100), 8);
  EXPECT_EQ(chosen.clusters.centres.size(), 1U);
  EXPECT_NEAR(chosen.clusters.centres[0].x, 0.5, 1e-12);
  EXPECT_EQ(choose_k(straight(100), 8, {.least_silhouette = 0.5}).clusters.centres.size(), 2U);
}

TEST(ChooseK, NeedsPointsToChooseFrom) {
  EXPECT_TRUE(choose_k({}, 4).clusters.centres.empty());
  EXPECT_EQ(choose_k(std::vector<Vec2>(5, Vec2{1.0, 1.0}), 4).clusters.centres.size(), 1U);
  EXPECT_EQ(choose_k(straight(5), 0).clusters.centres.size(), 1U);
  EXPECT_TRUE(choose_k(straight(5), 1).silhouettes.empty());
}

TEST(Silhouette, IsThatOfItsDefinition) {
  rc::check([](const std::vector<std::pair<std::int8_t, std::int8_t>>& raw) {
    std::vector<Vec2> points;
    std::vector<std::size_t> label;
    for (const auto& [x, y] : raw) {
      points.push_back({x / 8.0, y / 8.0});
      label.push_back(static_cast<std::size_t>(x + y) % 3);
    }
    const auto mean_distance = [&](std::size_t i, std::size_t c) {
      double sum = 0.0;
      double count = 0.0;
      for (std::size_t j = 0; j < points.size(); ++j) {
        if (j == i || label[j] != c) continue;
        sum += distance(points[i], points[j]);
        count += 1.0;
      }
      return sum / count;  // not a number of none
    };
    double total = 0.0;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const double a = mean_distance(i, label[i]);
      const double b = std::fmin(mean_distance(i, (label[i] + 1) % 3), mean_distance(i, (label[i] + 2) % 3));
      if (std::max(a, b) > 0.0) total += (b - a) / std::max(a, b);  // alone, a is not a number: 0
    }
    const double expected =
        points.empty() || std::isnan(total) ? 0.0 : total / static_cast<double>(points.size());
    RC_ASSERT(std::abs(silhouette(points, label, 3) - expected) < 1e-12);
  });
}

}  // namespace
}  // namespace verge::cluster
