// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/scan/quadrants.hpp"

#include <cmath>
#include <numbers>
#include <numeric>
#include <utility>

#include <gtest/gtest.h>

#include "verge/scan/organise.hpp"

namespace verge {
namespace {

TEST(Quadrants, AreThePapersFourRegions) {
  // The paper's x is our -y, its y our x.
  EXPECT_EQ(quadrant_of({1.0, -1.0, 0.0}), Quadrant::kA);
  EXPECT_EQ(quadrant_of({1.0, 1.0, 0.0}), Quadrant::kB);
  EXPECT_EQ(quadrant_of({-1.0, -1.0, 0.0}), Quadrant::kC);
  EXPECT_EQ(quadrant_of({-1.0, 1.0, 0.0}), Quadrant::kD);
}

/// A levelled sensor 1.9 m over a plane, with rings of 3.5 to 21 m.
Scan flat_scan() {
  Cloud cloud;
  for (std::int64_t ring = 0; ring < 8; ++ring) {
    const double rho = 3.5 + 2.5 * static_cast<double>(ring);
    for (int i = 0; i < 500; ++i) {
      const double azimuth = 2.0 * std::numbers::pi * (i + 0.5) / 500.0;
      cloud.x.push_back(static_cast<float>(rho * std::cos(azimuth)));
      cloud.y.push_back(static_cast<float>(rho * std::sin(azimuth)));
      cloud.z.push_back(i % 10 == 0 ? -1.8F : -1.9F);  // some stand 0.1 m over it
      cloud.ring.push_back(ring);
    }
  }
  Scan scan = organise(std::move(cloud)).scan;
  scan.mount = Mount{1.9, 0.0, 0.0, 0.0};
  return scan;
}

TEST(SplitQuadrants, HandsOnEveryLowPointOnceAndEachLayerFromTheAxisOutward) {
  const Scan scan = flat_scan();
  const auto low = height_gate(scan, LevelFrame(*scan.mount), {});
  const auto layers = split_quadrants(low);
  const auto count = [](const auto& parts) {
    return std::accumulate(parts.begin(), parts.end(), std::size_t{0},
                           [](std::size_t n, const auto& part) { return n + part.points.size(); });
  };
  EXPECT_EQ(count(layers), count(low));
  for (const QuadrantRing& layer : layers) {
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
  Scan scan = flat_scan();
  const LevelFrame frame(*scan.mount);
  const auto low =
      height_gate(scan, frame, {.height_max_m = 0.05, .lateral_max_m = 6.0, .forward_max_m = 9.0});
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
  Scan scan = flat_scan();
  const auto before = height_gate(scan, LevelFrame(*scan.mount), {});
  for (std::size_t i = scan.ring_begin[0]; i < scan.ring_begin[1]; ++i) scan.range[i] = 0.0F;
  const auto after = height_gate(scan, LevelFrame(*scan.mount), {});
  EXPECT_EQ(after.size() + 1, before.size());
}

}  // namespace
}  // namespace verge
