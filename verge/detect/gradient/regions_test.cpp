// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/detect/gradient/regions.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "verge/core/angle.hpp"
#include "verge/detect/test_kerbs.hpp"

namespace verge::detect::gradient {
namespace {

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

TEST(Regions, AreOfWhatTheGateOfTheSettingsLeaves) {
  GradientConfig config;
  config.forward_max_m = 9.0;
  const Scan scan = testing::kerb_scan({}, 8);
  const auto low = height_gate(scan, LevelFrame(*scan.mount), config);
  ASSERT_FALSE(low.empty());
  for (const LowRing& ring : low) {
    for (const Vec3 p : ring.points) EXPECT_LT(std::abs(p.x), 9.0);
  }
}

TEST(AcrossBeams, RangeDoesNotCount) {
  EXPECT_DOUBLE_EQ(across_beams({3.0, 4.0, 0.0}, {6.0, 8.0, 1.0}), 0.0);
  EXPECT_NEAR(across_beams({10.0, 0.0, 0.0}, {10.0 * std::cos(0.01), 10.0 * std::sin(0.01), 0.0}), 0.1, 1e-5);
  EXPECT_EQ(across_beams({0.0, 0.0, 0.0}, {0.0, 0.0, 1.0}), 0.0);
}

}  // namespace
}  // namespace verge::detect::gradient
