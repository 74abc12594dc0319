// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/detect/gradient/candidates.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "verge/core/angle.hpp"
#include "verge/detect/test_kerbs.hpp"

namespace verge::detect::gradient {
namespace {

/// A layer straight to the left with groups of points 0.1 m apart, the groups separated by 2 m.
Layer groups(std::initializer_list<std::size_t> sizes) {
  Layer layer{0, Quadrant::kB, deg_to_rad(-10.0), 0.003, {}};
  double y = 3.0;
  for (const std::size_t size : sizes) {
    for (std::size_t i = 0; i < size; ++i) layer.points.push_back({5.0, y += 0.1, 0.1});
    y += 2.0;
  }
  return layer;
}

GradientPoints all_of(const Layer& layer) {
  GradientPoints points;
  for (std::size_t i = 0; i < layer.points.size(); ++i) {
    points.index.push_back(i);
    points.rise_m.push_back(0.1);
  }
  return points;
}

TEST(ClusterLayer, KIsOnePlusTheNumberOfGaps) {
  for (const Clustering clustering : {Clustering::kRuns, Clustering::kKMeans}) {
    GradientConfig config;
    config.clustering = clustering;
    for (const auto& sizes : {std::initializer_list<std::size_t>{6}, {6, 7}, {5, 9, 4, 8}}) {
      const Layer layer = groups(sizes);
      const LayerClusters found = cluster_layer(layer, all_of(layer), config);
      EXPECT_EQ(found.K, sizes.size());
      ASSERT_EQ(found.clusters.size(), sizes.size());
      auto size = sizes.begin();
      for (const auto& cluster : found.clusters) EXPECT_EQ(cluster.size(), *size++);
    }
  }
}

TEST(ClusterLayer, ClustersBelowTheThresholdAreNoise) {
  const Layer layer = groups({2, 6, 1, 3});
  const LayerClusters found = cluster_layer(layer, all_of(layer), {});
  EXPECT_EQ(found.K, 4U);
  ASSERT_EQ(found.clusters.size(), 2U);
  EXPECT_EQ(found.clusters[0].size(), 6U);
  EXPECT_EQ(found.clusters[1].size(), 3U);
}

TEST(ClusterLayer, AsPrintedKIsThePlaceOfTheLastGap) {
  GradientConfig config;
  config.reading = Reading::kPaper;
  const Layer layer = groups({4, 3, 5});
  EXPECT_EQ(cluster_layer(layer, all_of(layer), config).K, 7U);  // d_7 is the last distance above m
  const Layer whole = groups({4});
  EXPECT_EQ(cluster_layer(whole, all_of(whole), config).K, 1U);
}

TEST(ClusterLayer, NothingGivesNothing) {
  const LayerClusters found = cluster_layer(groups({}), {}, {});
  EXPECT_EQ(found.K, 0U);
  EXPECT_TRUE(found.clusters.empty());
}

class FootIn : public ::testing::TestWithParam<Quadrant> {};

TEST_P(FootIn, LiesAtTheFootOfTheStepOnTheRoadsSide) {
  const GradientConfig config;
  for (const double elevation_deg : {-16.0, -12.0, -8.0}) {
    const Layer layer = testing::kerb_layer({}, GetParam(), deg_to_rad(elevation_deg));
    const GradientPoints points = gradient_points(layer, config);
    const auto candidate =
        first_outward(layer, points, cluster_layer(layer, points, config), Obstacles({}, config), config);
    ASSERT_TRUE(candidate.has_value());
    EXPECT_NEAR(std::abs(candidate->foot.y), 4.0, 0.02);
    EXPECT_NEAR(candidate->foot.z, 0.0, 0.02);
    EXPECT_FALSE(candidate->obstacle);
  }
}

INSTANTIATE_TEST_SUITE_P(All, FootIn, ::testing::ValuesIn(kQuadrants));

TEST(FirstOutward, AStepThatIsHigherThanAKerbWithinAStrideEndsTheRoadAtAnObstacle) {
  testing::KerbScene wall;
  wall.kerb_m = 0.9;
  wall.lateral_m = 2.5;
  const GradientConfig config;
  const Layer layer =
      testing::kerb_layer(wall, Quadrant::kB, deg_to_rad(-25.0));  // 0.47 m of face a metre of scan line
  const GradientPoints points = gradient_points(layer, config);
  ASSERT_FALSE(points.index.empty());
  GradientConfig strict = config;
  strict.rise_max_m = 0.1;
  const LayerClusters clusters = cluster_layer(layer, points, strict);
  EXPECT_FALSE(first_outward(layer, points, clusters, Obstacles({}, strict), strict));
  const auto candidate = first_outward(layer, points, clusters, Obstacles({}, config), config);
  ASSERT_TRUE(candidate.has_value());
  EXPECT_GT(candidate->height_m, config.rise_max_m);  // what stands there is a wall
}

TEST(Obstacles, StandAboveAFootWhereHighReturnsDo) {
  const GradientConfig config;
  const LowRing ring{3, 0.0, 0.003, {{6.0, 4.1, 1.4}, {-10.0, -3.0, 0.2}}};
  const Obstacles obstacles({ring}, config);
  EXPECT_TRUE(obstacles.stand_above({6.0, 4.0, 0.0}, Quadrant::kB));
  EXPECT_FALSE(obstacles.stand_above({9.0, 4.0, 0.0}, Quadrant::kB));     // elsewhere along the road
  EXPECT_FALSE(obstacles.stand_above({-10.0, -3.0, 0.0}, Quadrant::kC));  // what is there is low
  EXPECT_FALSE(obstacles.stand_above({0.0, 0.0, 0.0}, Quadrant::kB));
}

}  // namespace
}  // namespace verge::detect::gradient
