// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/cluster/runs.hpp"

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <vector>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace verge::cluster {
namespace {

/// Groups of points 0.1 m apart along x, with `gap` metres between one group's last and the next one's first.
std::vector<Vec2> groups(const std::vector<int>& sizes, double gap) {
  std::vector<Vec2> points;
  double x = 0.0;
  for (const int size : sizes) {
    for (int i = 0; i < size; ++i) points.push_back({x + 0.1 * i, 1.0});
    x = points.back().x + gap;
  }
  return points;
}

TEST(Runs, AdjacentDistancesAreOneFewerThanThePoints) {
  const std::vector<double> d = adjacent_distances(std::vector<Vec2>{{0.0, 0.0}, {3.0, 4.0}, {3.0, 4.0}});
  EXPECT_EQ(d, (std::vector<double>{5.0, 0.0}));
  EXPECT_EQ(adjacent_distances(std::vector<Vec3>{{0.0, 0.0, 0.0}, {1.0, 2.0, 2.0}}),
            (std::vector<double>{3.0}));
  EXPECT_TRUE(adjacent_distances(std::vector<Vec2>{{1.0, 1.0}}).empty());
  EXPECT_TRUE(adjacent_distances(std::vector<Vec2>{}).empty());
}

TEST(Runs, KIsOneMoreThanTheNumberOfGaps) {
  const auto points = groups({5, 3, 7, 1}, 0.8);
  const auto runs = gap_separated_runs(points.size(), adjacent_distances(points), 0.3);
  EXPECT_EQ(runs, (std::vector<PointRun>{{0, 5}, {5, 8}, {8, 15}, {15, 16}}));
}

TEST(Runs, ADistanceEqualToTheThresholdIsNoGap) {
  const std::vector<Vec2> points{{0.0, 0.0}, {0.5, 0.0}, {1.5, 0.0}};
  EXPECT_EQ(gap_separated_runs(3, adjacent_distances(points), 0.5).size(), 2U);
  EXPECT_EQ(gap_separated_runs(3, adjacent_distances(points), 1.0).size(), 1U);
}

TEST(Runs, EachDistanceCanHaveItsOwnThreshold) {
  const std::vector<double> d{0.4, 0.4, 0.4};
  EXPECT_EQ(gap_separated_runs(4, d, std::vector<double>{0.3, 0.5, 0.3}),
            (std::vector<PointRun>{{0, 1}, {1, 3}, {3, 4}}));
}

TEST(Runs, NoPointsGiveNoRunsAndOnePointGivesOne) {
  EXPECT_TRUE(gap_separated_runs(0, {}, 0.3).empty());
  EXPECT_EQ(gap_separated_runs(1, {}, 0.3), (std::vector<PointRun>{{0, 1}}));
}

TEST(Runs, ThePrintedLoopGivesThePlaceOfTheLastGap) {
  const auto points = groups({5, 3, 7}, 0.8);  // gaps after the 5th and the 8th point
  const auto d = adjacent_distances(points);
  EXPECT_EQ(cluster_count_as_printed(d, 0.3), 8U);
  EXPECT_EQ(gap_separated_runs(points.size(), d, 0.3).size(), 3U);
  EXPECT_EQ(cluster_count_as_printed(d, 1.0), 1U);
  EXPECT_EQ(cluster_count_as_printed({}, 0.3), 1U);
}

TEST(Runs, TheThresholdOnSizeIsExclusive) {
  const std::vector<PointRun> runs{{0, 2}, {2, 5}, {5, 9}};
  EXPECT_EQ(keep_larger_than(runs, 2), (std::vector<PointRun>{{2, 5}, {5, 9}}));
  EXPECT_TRUE(keep_larger_than(runs, 4).empty());
}

TEST(Runs, MeansAreOfEachRunsOwnPoints) {
  const std::vector<Vec2> points{{0.0, 0.0}, {2.0, 4.0}, {7.0, 1.0}};
  EXPECT_EQ(run_means(points, std::vector<PointRun>{{0, 2}, {2, 3}}),
            (std::vector<Vec2>{{1.0, 2.0}, {7.0, 1.0}}));
}

TEST(Runs, PartitionThePointsAndBreakExactlyAtTheGaps) {
  rc::check([](const std::vector<std::uint8_t>& raw) {
    std::vector<double> d(raw.begin(), raw.end());
    const auto runs = gap_separated_runs(d.size() + 1, d, 100.0);
    std::size_t next = 0;
    for (const PointRun& run : runs) {
      RC_ASSERT(run.begin == next && run.end > run.begin);
      if (run.begin > 0) RC_ASSERT(d[run.begin - 1] > 100.0);
      for (std::size_t i = run.begin; i + 1 < run.end; ++i) RC_ASSERT(d[i] <= 100.0);
      next = run.end;
    }
    RC_ASSERT(next == d.size() + 1);
    const auto gaps = std::ranges::count_if(d, [](double v) { return v > 100.0; });
    RC_ASSERT(runs.size() == 1 + static_cast<std::size_t>(gaps));
  });
}

TEST(Runs, ReversingThePointsReversesTheRuns) {
  rc::check([](const std::vector<std::uint8_t>& raw) {
    std::vector<double> d(raw.begin(), raw.end());
    const std::size_t n = d.size() + 1;
    auto expected = gap_separated_runs(n, d, 100.0);
    std::ranges::reverse(expected);
    for (PointRun& run : expected) run = {n - run.end, n - run.begin};
    std::ranges::reverse(d);
    RC_ASSERT(gap_separated_runs(n, d, 100.0) == expected);
  });
}

}  // namespace
}  // namespace verge::cluster
