// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/detect/gradient/regions.hpp"

#include <numeric>

#include <gtest/gtest.h>

#include "verge/core/angle.hpp"
#include "verge/detect/gradient/kerb_scene.hpp"

namespace verge::detect::gradient {
namespace {

TEST(Quadrants, AreThePapersFourRegions) {
  // The paper's x is our -y, its y our x.
  EXPECT_EQ(quadrant_of({1.0, -1.0, 0.0}), Quadrant::kA);
  EXPECT_EQ(quadrant_of({1.0, 1.0, 0.0}), Quadrant::kB);
  EXPECT_EQ(quadrant_of({-1.0, -1.0, 0.0}), Quadrant::kC);
  EXPECT_EQ(quadrant_of({-1.0, 1.0, 0.0}), Quadrant::kD);
}

/// The table of A2.2-1: along a scan line taken counter-clockwise, from where to where the heights go.
class KerbInQuadrant : public ::testing::TestWithParam<Quadrant> {};

TEST_P(KerbInQuadrant, HeightsIncreaseOutwardAndCounterClockwiseWithTheQuadrantsSign) {
  const Layer layer = testing::kerb_layer({}, GetParam(), deg_to_rad(-12.0));
  ASSERT_GT(layer.points.size(), 100U);
  double outward = 0.0;
  for (std::size_t i = 1; i < layer.points.size(); ++i) {
    EXPECT_GE(layer.points[i].z, layer.points[i - 1].z - 1e-9);  // never falling from the road outward
    outward += layer.points[i].z - layer.points[i - 1].z;
  }
  EXPECT_NEAR(outward, 0.12, 1e-9);

  const double counter_clockwise = outward_sign(GetParam()) * outward;
  const bool decreasing = GetParam() == Quadrant::kA || GetParam() == Quadrant::kD;
  EXPECT_EQ(counter_clockwise < 0.0, decreasing);
}

TEST_P(KerbInQuadrant, HorizontalRangeShrinksOnTheFaceOutward) {
  const Layer layer = testing::kerb_layer({}, GetParam(), deg_to_rad(-12.0));
  for (std::size_t i = 1; i < layer.points.size(); ++i) {
    const bool on_face = layer.points[i].z > 1e-6 && layer.points[i].z < 0.12 - 1e-6;
    if (!on_face) continue;
    EXPECT_LT(norm(layer.points[i].xy()), norm(layer.points[i - 1].xy()));
  }
}

INSTANTIATE_TEST_SUITE_P(All, KerbInQuadrant, ::testing::ValuesIn(kQuadrants));

TEST(SplitQuadrants, HandsOnEveryLowPointOnceAndEachLayerFromTheAxisOutward) {
  const Scan scan = testing::kerb_scan({}, 8);
  const auto low = height_gate(scan, LevelFrame(*scan.mount), {});
  const auto layers = split_quadrants(low);
  const auto count = [](const auto& parts) {
    return std::accumulate(parts.begin(), parts.end(), std::size_t{0},
                           [](std::size_t n, const auto& part) { return n + part.points.size(); });
  };
  EXPECT_EQ(count(layers), count(low));
  for (const Layer& layer : layers) {
    double last = -1.0;
    for (const Vec3 p : layer.points) {
      EXPECT_EQ(quadrant_of(p), layer.region);
      const double from_axis = std::atan2(std::abs(p.y), std::abs(p.x));
      EXPECT_GE(from_axis, last);
      last = from_axis;
    }
  }
}

TEST(HeightGate, KeepsWhatIsLowAndInTheRegionOfInterest) {
  Scan scan = testing::kerb_scan({}, 8);
  const LevelFrame frame(*scan.mount);
  GradientConfig config;
  config.height_max_m = 0.05;
  config.lateral_max_m = 6.0;
  config.forward_max_m = 9.0;
  const auto low = height_gate(scan, frame, config);
  ASSERT_FALSE(low.empty());
  for (const LowRing& ring : low) {
    for (const Vec3 p : ring.points) {
      EXPECT_LT(p.z, 0.05);
      EXPECT_LT(std::abs(p.y), 6.0);
      EXPECT_LT(std::abs(p.x), 9.0);
    }
  }
}

TEST(HeightGate, ReturnsOfRangeZeroAreNoReturns) {
  Scan scan = testing::kerb_scan({}, 4);
  const auto before = height_gate(scan, LevelFrame(*scan.mount), {});
  for (std::size_t i = scan.ring_begin[0]; i < scan.ring_begin[1]; ++i) scan.range[i] = 0.0F;
  const auto after = height_gate(scan, LevelFrame(*scan.mount), {});
  EXPECT_EQ(after.size() + 1, before.size());
}

}  // namespace
}  // namespace verge::detect::gradient
