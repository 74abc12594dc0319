// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/cluster/breakpoints.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace verge::cluster {
namespace {

using Clusters = std::vector<std::vector<std::size_t>>;

constexpr double kDegree = std::numbers::pi / 180.0;

/// Where rays every half degree from `from_deg` to `to_deg` meet the line x cos(normal) + y sin(normal) =
/// far.
std::vector<Vec2> on_wall(double from_deg, double to_deg, double normal_deg, double far_m) {
  std::vector<Vec2> points;
  for (double deg = from_deg; deg <= to_deg + 1e-9; deg += 0.5) {
    const double range_m = far_m / std::cos((deg - normal_deg) * kDegree);
    points.push_back({range_m * std::cos(deg * kDegree), range_m * std::sin(deg * kDegree)});
  }
  return points;
}

void append(std::vector<Vec2>& to, const std::vector<Vec2>& from) {
  to.insert(to.end(), from.begin(), from.end());
}

std::vector<std::size_t> sizes_of(const Clusters& clusters) {
  std::vector<std::size_t> sizes;
  for (const auto& cluster : clusters) sizes.push_back(cluster.size());
  return sizes;
}

TEST(Breakpoints, TheGapIsThatOfASurfaceMetAtLambda) {
  // The next ray meets a surface at lambda from the first one at the same distance by the law of sines.
  const double lambda = 10.0 * kDegree;
  const double step = 0.5 * kDegree;
  EXPECT_NEAR(breakpoint_gap_m(20.0, step, lambda, 0.0), 20.0 * std::sin(step) / std::sin(9.5 * kDegree),
              1e-12);
  EXPECT_NEAR(breakpoint_gap_m(20.0, 0.0, lambda, 0.03), 0.09, 1e-12);
  EXPECT_NEAR(breakpoint_gap_m(20.0, lambda, lambda, 0.03), 0.09, 1e-12);
}

TEST(Breakpoints, PartABoxFromTheWallBehindIt) {
  std::vector<Vec2> points = on_wall(-5.0, -1.5, 0.0, 20.0);
  append(points, on_wall(-1.0, 1.0, 0.0, 10.0));
  append(points, on_wall(1.5, 5.0, 0.0, 20.0));
  EXPECT_EQ(sizes_of(breakpoint_clusters(points)), (std::vector<std::size_t>{8, 5, 8}));
  // Looking back past the five directions of the box, both parts of the wall are one.
  EXPECT_EQ(sizes_of(breakpoint_clusters(points, {.look_back = 6})), (std::vector<std::size_t>{16, 5}));
}

TEST(Breakpoints, SurfacesAreFollowedDownToLambda) {
  // Parallel to the ray at 0 degrees, so that each point is met at its own azimuth.
  const auto steep = on_wall(12.0, 20.0, 90.0, 2.0);
  const auto flat = on_wall(4.0, 8.0, 90.0, 2.0);
  EXPECT_EQ(breakpoint_clusters(steep).size(), 1U);
  EXPECT_EQ(breakpoint_clusters(flat, {.sigma_m = 0.0}).size(), flat.size());
  // Along x they are followed flatter, where that is asked for.
  const BreakpointOptions along_x{.sigma_m = 0.0, .flat_rad = 3.0 * kDegree, .beside_m = 0.2};
  EXPECT_EQ(breakpoint_clusters(flat, along_x).size(), 1U);
  std::vector<Vec2> along_y;
  for (const Vec2 p : flat) along_y.push_back({p.y, p.x});
  EXPECT_EQ(breakpoint_clusters(along_y, along_x).size(), flat.size());
  // Anywhere where they go straight on, which takes two points to tell.
  std::vector<Vec2> bend = on_wall(12.0, 20.0, 90.0, 2.0);
  const auto onward = on_wall(6.0, 11.5, 90.0, 2.0);
  bend.insert(bend.begin(), onward.begin(), onward.end());  // first the part that is met flatter
  EXPECT_GT(breakpoint_clusters(bend, {.sigma_m = 0.0}).size(), 5U);
  EXPECT_EQ(breakpoint_clusters(bend, {.sigma_m = 0.0, .flat_rad = 3.0 * kDegree, .straight_m = 0.1}).size(),
            1U);
}

TEST(Breakpoints, EchoesOfOneShotFollowTheirOwnSurfaces) {
  std::vector<Vec2> points;
  const auto near = on_wall(-2.0, 2.0, 0.0, 10.0);
  const auto far = on_wall(-2.0, 2.0, 0.0, 14.0);
  for (std::size_t i = 0; i < near.size(); ++i) append(points, {near[i], far[i]});
  EXPECT_EQ(breakpoint_clusters(points),
            (Clusters{{0, 2, 4, 6, 8, 10, 12, 14, 16}, {1, 3, 5, 7, 9, 11, 13, 15, 17}}));
}

TEST(Breakpoints, NoSurfaceSpansDirectionsWithoutReturns) {
  std::vector<Vec2> points = on_wall(-3.0, -1.0, 0.0, 10.0);
  append(points, on_wall(1.0, 3.0, 0.0, 10.0));
  EXPECT_EQ(breakpoint_clusters(points).size(), 1U);
  EXPECT_EQ(breakpoint_clusters(points, {.step_max_rad = 1.5 * kDegree}).size(), 2U);
}

RC_GTEST_PROP(BreakpointsLaw, AMirrorChangesNothing, (const std::vector<std::uint8_t>& ranges)) {
  const BreakpointOptions options{
      .look_back = 2, .flat_rad = 3.0 * kDegree, .straight_m = 0.1, .beside_m = 0.2};
  std::vector<Vec2> points;
  std::vector<Vec2> mirrored;
  for (std::size_t i = 0; i < ranges.size(); ++i) {
    const double azimuth = -20.0 * kDegree + 0.5 * kDegree * static_cast<double>(i);
    const double range_m = 5.0 + ranges[i] / 32.0;
    points.push_back({range_m * std::cos(azimuth), range_m * std::sin(azimuth)});
    mirrored.insert(mirrored.begin(), {points.back().x, -points.back().y});
  }
  Clusters other = breakpoint_clusters(mirrored, options);
  for (auto& cluster : other) {
    for (std::size_t& i : cluster) i = points.size() - 1 - i;
    std::ranges::sort(cluster);
  }
  std::ranges::sort(other);
  RC_ASSERT(breakpoint_clusters(points, options) == other);
}

TEST(Breakpoints, OfFewPoints) {
  EXPECT_TRUE(breakpoint_clusters({}).empty());
  EXPECT_EQ(breakpoint_clusters(std::vector<Vec2>{{0.0, 0.0}}), (Clusters{{0}}));
  EXPECT_EQ(breakpoint_clusters(std::vector<Vec2>{{3.0, 0.0}, {3.0, 0.0}}), (Clusters{{0, 1}}));
}

TEST(MergeNear, LayersOfOneCarAreOneAndParkedCarsStayTwo) {
  std::vector<Vec2> points;
  Clusters layers(4);
  for (std::size_t layer = 0; layer < 2; ++layer) {
    for (std::size_t car = 0; car < 2; ++car) {  // of 4 m, 0.9 m apart
      for (int i = 0; i <= 16; ++i) {
        layers[2 * layer + car].push_back(points.size());
        points.push_back(
            {10.0 + 4.9 * static_cast<double>(car) + 0.25 * i, -2.0 - 0.1 * static_cast<double>(layer)});
      }
    }
  }
  const Clusters merged = merge_near(points, layers, 0.5);
  EXPECT_EQ(sizes_of(merged), (std::vector<std::size_t>{34, 34}));
  std::ranges::reverse(layers);
  EXPECT_EQ(merge_near(points, layers, 0.5), merged);
  EXPECT_EQ(merge_near(points, layers, 0.95).size(), 1U);
}

// Against the definition: two points are together where steps of gap_m lead from one to the other.
RC_GTEST_PROP(MergeNearLaw, OfSinglePointsTheyAreTheComponentsOfTheGraphOfSteps,
              (const std::vector<std::pair<std::uint8_t, std::uint8_t>>& raw)) {
  std::vector<Vec2> points;
  Clusters single;
  for (const auto& [x, y] : raw) {
    single.push_back({points.size()});
    points.push_back({x / 8.0, y / 8.0});
  }
  const double gap_m = 3.0;
  std::vector<std::size_t> component(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) component[i] = i;
  for (std::size_t round = 0; round < points.size(); ++round) {
    for (std::size_t i = 0; i < points.size(); ++i) {
      for (std::size_t k = 0; k < points.size(); ++k) {
        if (distance(points[i], points[k]) <= gap_m) component[i] = std::min(component[i], component[k]);
      }
    }
  }
  Clusters expected(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) expected[component[i]].push_back(i);
  std::erase_if(expected, [](const auto& cluster) { return cluster.empty(); });
  RC_ASSERT(merge_near(points, single, gap_m) == expected);
}

}  // namespace
}  // namespace verge::cluster
