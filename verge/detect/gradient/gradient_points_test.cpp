// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/detect/gradient/gradient_points.hpp"

#include <algorithm>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "verge/core/angle.hpp"
#include "verge/detect/test_kerbs.hpp"

namespace verge::detect::gradient {
namespace {

const double kElevation = deg_to_rad(-10.0);

class GradientIn : public ::testing::TestWithParam<Quadrant> {};

TEST_P(GradientIn, StandsAtTheKerbAndNowhereElse) {
  const Layer layer = testing::kerb_layer({}, GetParam(), kElevation);
  const GradientConfig config;
  const GradientPoints points = gradient_points(layer, config);
  ASSERT_FALSE(points.index.empty());
  for (const std::size_t i : points.index) {
    // What comes before is road and what follows within after_m reaches the face.
    EXPECT_NEAR(std::abs(layer.points[i].y), 4.0, config.after_m + 0.1);
  }
  const double greatest = *std::max_element(points.rise_m.begin(), points.rise_m.end());
  EXPECT_GT(greatest, 0.06);  // the scan line climbs the face over more than after_m
  EXPECT_LT(greatest, 0.12 + 1e-9);
}

TEST_P(GradientIn, AsPrintedStandsAtTheKerbAsWell) {
  const Layer layer = testing::kerb_layer({}, GetParam(), kElevation);
  const GradientPoints points = gradient_points_as_printed(layer, {});
  ASSERT_FALSE(points.index.empty());
  for (const double rise : points.rise_m) EXPECT_NEAR(rise, 0.12, 1e-9);
}

INSTANTIATE_TEST_SUITE_P(All, GradientIn, ::testing::ValuesIn(kQuadrants));

// At 20 m the scan line comes 1.3 m nearer while it climbs the face: along it the rise is as flat as a
// cross-fall.
TEST(GradientPoints, AKerbAheadIsFoundFarOut) {
  testing::KerbScene scene;
  scene.lateral_m = 3.0;
  for (const Quadrant region : kQuadrants) {
    const Layer layer = testing::kerb_layer(scene, region, deg_to_rad(-5.3));
    const GradientPoints points = gradient_points(layer, {});
    ASSERT_FALSE(points.index.empty());
    for (const std::size_t i : points.index) EXPECT_NEAR(std::abs(layer.points[i].y), 3.0, 0.4);
    EXPECT_GT(*std::max_element(points.rise_m.begin(), points.rise_m.end()), 0.06);
  }
}

// A kerb that runs along the beams is one jump of the scan line, from the road to the sidewalk.
TEST(GradientPoints, AStepAlongTheBeamsIsNoGapUnlessItIsHigh) {
  const Layer flat = testing::kerb_layer({.kerb_m = 0.0}, Quadrant::kB, deg_to_rad(-6.0));
  const auto with_step = [&](double height_m) {
    Layer layer = flat;
    for (std::size_t i = 100; i < layer.points.size(); ++i) {
      Vec3& p = layer.points[i];
      const double share = (1.9 - height_m) / 1.9;
      p = {share * p.x, share * p.y, height_m};
    }
    return gradient_points(layer, {}).index.size();
  };
  EXPECT_GT(with_step(0.15), 0U);
  EXPECT_EQ(with_step(0.6), 0U);
}

TEST(GradientPoints, AFlatRoadHasNone) {
  testing::KerbScene flat;
  flat.kerb_m = 0.0;
  EXPECT_TRUE(gradient_points(testing::kerb_layer(flat, Quadrant::kB, kElevation), {}).index.empty());
}

TEST(GradientPoints, CrossFallAloneIsNoBoundary) {
  testing::KerbScene flat;
  flat.kerb_m = 0.0;
  Layer layer = testing::kerb_layer(flat, Quadrant::kB, kElevation);
  for (Vec3& p : layer.points) p.z += 0.03 * p.y;  // 3 % up to the left
  EXPECT_TRUE(gradient_points(layer, {}).index.empty());
}

TEST(GradientPoints, AStepDownIsNoStepUp) {
  testing::KerbScene ditch;
  Layer layer = testing::kerb_layer(ditch, Quadrant::kB, kElevation);
  for (Vec3& p : layer.points) p.z = -p.z;
  EXPECT_TRUE(gradient_points(layer, {}).index.empty());
}

TEST(GradientPoints, NoiseOfTwoCentimetresMakesNoBoundaryOfAFlatRoad) {
  testing::KerbScene flat;
  flat.kerb_m = 0.0;
  std::mt19937 random(20261122);
  std::normal_distribution<double> noise(0.0, 0.02);
  std::size_t found = 0;
  std::size_t points = 0;
  for (int round = 0; round < 50; ++round) {
    Layer layer = testing::kerb_layer(flat, Quadrant::kB, kElevation);
    for (Vec3& p : layer.points) p.z += noise(random) * std::sin(-kElevation);  // along the beam
    found += gradient_points(layer, {}).index.size();
    points += layer.points.size();
  }
  EXPECT_LT(static_cast<double>(found), 1e-3 * static_cast<double>(points));
}

TEST(GradientPoints, NoGradientIsMeasuredAcrossAGap) {
  Layer layer = testing::kerb_layer({}, Quadrant::kB, kElevation);
  // Cut a metre of ring out around the face: road and sidewalk are then two pieces.
  std::erase_if(layer.points, [](Vec3 p) { return std::abs(p.y - 4.0) < 0.5; });
  EXPECT_TRUE(gradient_points(layer, {}).index.empty());
}

TEST(GradientPoints, ALayerOfAFewPointsIsDefined) {
  Layer layer = testing::kerb_layer({}, Quadrant::kB, kElevation);
  for (const std::size_t n : {0U, 1U, 2U, 5U}) {
    layer.points.resize(n);
    EXPECT_TRUE(gradient_points(layer, {}).index.empty());
    EXPECT_TRUE(gradient_points_as_printed(layer, {}).index.empty());
  }
}

/// Oracle: the same quantity without prefix sums or moving windows.
double rise_by_hand(const Layer& layer, std::size_t i, const GradientConfig& config) {
  const auto arc = arc_of(layer, config);
  double n = 0, s = 0, z = 0, ss = 0, sz = 0, m = 0, sa = 0, za = 0;
  for (std::size_t k = 0; k < arc.size(); ++k) {
    if (k < i && arc[k] >= arc[i] - config.before_m) {
      n += 1, s += arc[k], z += layer.points[k].z, ss += arc[k] * arc[k], sz += arc[k] * layer.points[k].z;
    }
    if (k >= i && arc[k] <= arc[i] + config.after_m) m += 1, sa += arc[k], za += layer.points[k].z;
  }
  const double slope = std::clamp((sz - s * z / n) / (ss - s * s / n), -0.15, 0.15);
  return za / m - (z / n + slope * (sa / m - s / n));
}

TEST(GradientPoints, RiseIsWhatTheDefinitionSays) {
  const Layer layer = testing::kerb_layer({}, Quadrant::kA, kElevation);
  const GradientPoints points = gradient_points(layer, {});
  ASSERT_FALSE(points.index.empty());
  for (std::size_t k = 0; k < points.index.size(); ++k) {
    EXPECT_NEAR(points.rise_m[k], rise_by_hand(layer, points.index[k], {}), 1e-9);
  }
}

}  // namespace
}  // namespace verge::detect::gradient
