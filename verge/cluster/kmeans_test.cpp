// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/cluster/kmeans.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "verge/cluster/runs.hpp"

namespace verge::cluster {
namespace {

using Raw = std::vector<std::pair<std::int8_t, std::int8_t>>;

std::vector<Vec2> points_of(const Raw& raw) {
  std::vector<Vec2> points;
  for (const auto& [x, y] : raw) points.push_back({static_cast<double>(x), static_cast<double>(y)});
  return points;
}

double squared(Vec2 d) { return dot(d, d); }

/// Sum of squared distances from the means of the groups that `label` makes.
double objective_of(const std::vector<Vec2>& points, const std::vector<std::size_t>& label, std::size_t k) {
  double sum = 0.0;
  for (std::size_t c = 0; c < k; ++c) {
    Vec2 total;
    double count = 0.0;
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (label[i] == c) total = total + points[i];
      if (label[i] == c) count += 1.0;
    }
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (label[i] == c) sum += squared(points[i] - (1.0 / count) * total);
    }
  }
  return sum;
}

struct Labelling {
  double objective = std::numeric_limits<double>::infinity();
  std::vector<std::size_t> label;
};

/// The best of all labellings into two clusters.
Labelling brute_force(const std::vector<Vec2>& points) {
  Labelling best;
  std::vector<std::size_t> label(points.size(), 0);
  for (std::size_t code = 0; code < (std::size_t{1} << points.size()); ++code) {
    for (std::size_t i = 0; i < label.size(); ++i) label[i] = (code >> i) & 1U;
    const double objective = objective_of(points, label, 2);
    if (objective < best.objective) best = {objective, label};
  }
  return best;
}

Vec2 mean_of_cluster(const std::vector<Vec2>& points, const std::vector<std::size_t>& label, std::size_t c) {
  Vec2 total;
  double count = 0.0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (label[i] != c) continue;
    total = total + points[i];
    count += 1.0;
  }
  return (1.0 / count) * total;
}

TEST(KMeans, TwoPairsHaveTheirMidpointsAsCentres) {
  const std::vector<Vec2> points{{0.0, 0.0}, {0.0, 2.0}, {10.0, 0.0}, {10.0, 2.0}};
  const auto result = kmeans(points, std::vector<Vec2>{{0.0, 0.0}, {10.0, 0.0}});
  EXPECT_EQ(result.label, (std::vector<std::size_t>{0, 0, 1, 1}));
  EXPECT_EQ(result.centres, (std::vector<Vec2>{{0.0, 1.0}, {10.0, 1.0}}));
  EXPECT_DOUBLE_EQ(result.objective.back(), 4.0);
  EXPECT_TRUE(result.converged);
}

TEST(KMeans, FromRunMeansTheClustersAreTheRuns) {
  std::vector<Vec2> points;
  for (const double x : {0.0, 4.0, 9.0}) {
    for (int i = 0; i < 6; ++i) points.push_back({x + 0.1 * i, 0.02 * (i % 3)});
  }
  const auto runs = gap_separated_runs(points.size(), adjacent_distances(points), 0.5);
  ASSERT_EQ(runs.size(), 3U);
  const auto result = kmeans(points, run_means(points, runs));
  for (std::size_t c = 0; c < runs.size(); ++c) {
    for (std::size_t i = runs[c].begin; i < runs[c].end; ++i) EXPECT_EQ(result.label[i], c);
  }
}

TEST(KMeans, APointMidwayGoesToTheFirstCentre) {
  const auto result = kmeans(std::vector<Vec2>{{0.0, 0.0}}, std::vector<Vec2>{{1.0, 0.0}, {-1.0, 0.0}});
  EXPECT_EQ(result.label, (std::vector<std::size_t>{0}));
}

TEST(KMeans, AnEmptyClusterKeepsItsCentre) {
  const std::vector<Vec2> points{{0.0, 0.0}, {1.0, 0.0}};
  const auto result = kmeans(points, std::vector<Vec2>{{0.5, 0.0}, {50.0, 50.0}});
  EXPECT_EQ(result.label, (std::vector<std::size_t>{0, 0}));
  EXPECT_EQ(result.centres[1], (Vec2{50.0, 50.0}));
}

TEST(KMeans, NoPointsLeaveTheCentresWhereTheyAre) {
  const auto result = kmeans(std::vector<Vec2>{}, std::vector<Vec2>{{1.0, 2.0}});
  EXPECT_TRUE(result.label.empty());
  EXPECT_EQ(result.centres, (std::vector<Vec2>{{1.0, 2.0}}));
}

TEST(KMeans, MovesAreBounded) {
  const std::vector<Vec2> points{{0.0, 0.0}, {1.0, 0.0}, {2.0, 0.0}, {9.0, 0.0}};
  const std::vector<Vec2> initial{{0.0, 0.0}, {1.0, 0.0}};
  const auto stopped = kmeans(points, initial, {.max_iterations = 1});
  EXPECT_FALSE(stopped.converged);
  EXPECT_EQ(stopped.objective.size(), 2U);  // once before and once after the one move
  EXPECT_TRUE(kmeans(points, initial).converged);
}

TEST(KMeans, WorksInSpaceToo) {
  const std::vector<Vec3> points{{0.0, 0.0, 0.0}, {0.0, 0.0, 5.0}, {0.0, 0.0, 6.0}};
  const auto result = kmeans(points, farthest_first(points, 2));
  EXPECT_EQ(result.label[1], result.label[2]);
  EXPECT_NE(result.label[0], result.label[1]);
}

TEST(KMeans, TheObjectiveNeverRises) {
  rc::check([](const Raw& raw) {
    const auto points = points_of(raw);
    RC_PRE(!points.empty());
    const auto k = *rc::gen::inRange<std::size_t>(1, points.size() + 1);
    const auto result = kmeans(points, std::span(points).first(k));
    for (std::size_t i = 1; i < result.objective.size(); ++i)
      RC_ASSERT(result.objective[i] <= result.objective[i - 1] * (1.0 + 1e-12));
  });
}

TEST(KMeans, EveryPointEndsAtItsNearestCentreAndEveryCentreAtItsMean) {
  rc::check([](const Raw& raw) {
    const auto points = points_of(raw);
    const auto result = kmeans(points, farthest_first(points, 3));
    RC_PRE(!points.empty());
    RC_ASSERT(result.converged);
    for (std::size_t i = 0; i < points.size(); ++i) {
      for (const Vec2 centre : result.centres)
        RC_ASSERT(squared(points[i] - result.centres[result.label[i]]) <= squared(points[i] - centre));
    }
    const double at_means = objective_of(points, result.label, result.centres.size());
    RC_ASSERT(std::abs(at_means - result.objective.back()) <= 1e-9 * (1.0 + at_means));
  });
}

TEST(KMeans, IsNeverBetterThanTheBestOfAllLabellingsAndStaysThere) {
  rc::check([](const Raw& raw) {
    auto points = points_of(raw);
    points.resize(std::min<std::size_t>(points.size(), 7));
    const auto seeds = farthest_first(points, 2);
    RC_PRE(seeds.size() == 2U);
    const Labelling best = brute_force(points);
    RC_ASSERT(kmeans(points, seeds).objective.back() >= best.objective - 1e-9);
    const std::vector<Vec2> means{mean_of_cluster(points, best.label, 0),
                                  mean_of_cluster(points, best.label, 1)};
    RC_ASSERT(std::abs(kmeans(points, means).objective.back() - best.objective) < 1e-9);
  });
}

TEST(KMeans, SeparatedGroupsGiveTheBestOfAllLabellings) {
  rc::check([](const Raw& raw) {
    std::vector<Vec2> points;
    for (std::size_t i = 0; i < std::min<std::size_t>(raw.size(), 7); ++i) {
      const Vec2 offset{i % 2 == 0 ? 0.0 : 100.0, 0.0};
      points.push_back(offset + Vec2{raw[i].first / 64.0, raw[i].second / 64.0});
    }
    RC_PRE(points.size() >= 2U);
    const auto result = kmeans(points, farthest_first(points, 2));
    RC_ASSERT(std::abs(result.objective.back() - brute_force(points).objective) < 1e-9);
  });
}

TEST(NearestToMean, IsTheCentroidOfPaperTwosTableFour) {
  const std::vector<Vec2> points{{61.0, 100.0}, {64.0, 150.0}, {70.0, 140.0}};  // A, B, C
  const Vec2 mean = kmeans(points, std::span(points).first(1)).centres[0];
  EXPECT_EQ(mean, (Vec2{65.0, 130.0}));                    // Eq. (7)
  EXPECT_NEAR(distance(mean, points[0]), 30.27, 5e-3);     // Eq. (8)
  EXPECT_NEAR(distance(mean, points[1]), 20.02, 5.01e-3);  // Eq. (9): 20.0250, printed as 20.02
  EXPECT_NEAR(distance(mean, points[2]), 11.18, 5e-3);     // Eq. (10)
  EXPECT_EQ(nearest_to_mean(points), points[2]);
  EXPECT_EQ(farthest_first(points, 2), (std::vector<Vec2>{points[2], points[0]}));
}

TEST(NearestToMean, OfEquallyNearPointsIsTheLowestAndOfNoneNone) {
  EXPECT_EQ(nearest_to_mean(std::vector<Vec2>{{1.0, 0.0}, {-1.0, 0.0}}), (Vec2{-1.0, 0.0}));
  EXPECT_FALSE(nearest_to_mean(std::vector<Vec2>{}));
  EXPECT_EQ(nearest_to_mean(std::vector<Vec3>{{0.0, 0.0, 4.0}}), (Vec3{0.0, 0.0, 4.0}));
}

TEST(FarthestFirst, StartsAtTheMedoidOfTheMeanAndGoesToTheFarthest) {
  const std::vector<Vec2> points{{0.0, 0.0}, {1.0, 0.0}, {2.0, 0.0}, {10.0, 0.0}};
  EXPECT_EQ(farthest_first(points, 3), (std::vector<Vec2>{{2.0, 0.0}, {10.0, 0.0}, {0.0, 0.0}}));
}

TEST(FarthestFirst, GivesNoMoreCentresThanDistinctPoints) {
  EXPECT_EQ(farthest_first(std::vector<Vec2>{{1.0, 1.0}, {1.0, 1.0}}, 5).size(), 1U);
  EXPECT_TRUE(farthest_first(std::vector<Vec2>{}, 5).empty());
  EXPECT_TRUE(farthest_first(std::vector<Vec2>{{1.0, 1.0}}, 0).empty());
}

TEST(FarthestFirst, OfEquallyFarPointsTakesTheLowest) {
  const std::vector<Vec2> centres{{0.0, 0.0}, {-1.0, 0.0}, {1.0, 0.0}};
  EXPECT_EQ(farthest_first(std::vector<Vec2>{{1.0, 0.0}, {0.0, 0.0}, {-1.0, 0.0}}, 3), centres);
  EXPECT_EQ(farthest_first(std::vector<Vec2>{{-1.0, 0.0}, {0.0, 0.0}, {1.0, 0.0}}, 3), centres);
}

TEST(FarthestFirst, DoesNotDependOnTheOrderOfThePoints) {
  rc::check([](const Raw& raw) {
    auto points = points_of(raw);
    const auto centres = farthest_first(points, 4);
    std::ranges::reverse(points);
    RC_ASSERT(farthest_first(points, 4) == centres);
    const auto by_y = [](Vec2 a, Vec2 b) { return std::pair{a.y, a.x} < std::pair{b.y, b.x}; };
    std::ranges::sort(points, by_y);
    RC_ASSERT(farthest_first(points, 4) == centres);
  });
}

TEST(Clusters, HoldTheirPointsIndicesInOrder) {
  const std::vector<std::size_t> label{1, 0, 1, 1, 3};
  const auto clusters = clusters_of(label, 4);
  EXPECT_EQ(clusters, (std::vector<std::vector<std::size_t>>{{1}, {0, 2, 3}, {}, {4}}));
  EXPECT_EQ(keep_larger_than(clusters, 1), (std::vector<std::vector<std::size_t>>{{0, 2, 3}}));
  EXPECT_EQ(keep_larger_than(clusters, 0).size(), 3U);
}

}  // namespace
}  // namespace verge::cluster
