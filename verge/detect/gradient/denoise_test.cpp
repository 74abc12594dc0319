// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/detect/gradient/denoise.hpp"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "verge/core/angle.hpp"

namespace verge::detect::gradient {
namespace {

constexpr double kHeight = 1.9;

Candidate at(std::size_t ring, double x, double y, bool obstacle = false) {
  return {ring, deg_to_rad(-20.0 + static_cast<double>(ring)), {x, y, 0.0}, 0.12, obstacle};
}

/// Feet along a straight kerb at y, on rings one degree apart.
std::vector<Candidate> kerb(double y, std::size_t rings, double direction = 1.0) {
  std::vector<Candidate> feet;
  for (std::size_t r = 0; r < rings; ++r)
    feet.push_back(at(r, direction * (4.0 + 0.4 * static_cast<double>(r)), y));
  return feet;
}

TEST(LinkLayers, OneKerbIsOneChain) {
  const auto chains = link_layers(Quadrant::kB, kerb(4.0, 8), kHeight, {});
  ASSERT_EQ(chains.size(), 1U);
  EXPECT_EQ(chains[0].points.size(), 8U);
}

TEST(LinkLayers, ALonePointAsideIsNoise) {
  auto feet = kerb(4.0, 8);
  feet[3] = at(3, 5.2, 1.0);
  const auto chains = link_layers(Quadrant::kB, feet, kHeight, {});
  ASSERT_EQ(chains.size(), 1U);
  EXPECT_EQ(chains[0].points.size(), 7U);  // the scan line is skipped
}

TEST(LinkLayers, AKerbThatStepsBackIsTwoChains) {
  std::vector<Candidate> feet = kerb(4.0, 4);
  for (std::size_t r = 4; r < 8; ++r) feet.push_back(at(r, 4.0 + 0.4 * static_cast<double>(r), 6.5));
  EXPECT_EQ(link_layers(Quadrant::kB, feet, kHeight, {}).size(), 2U);
}

TEST(LinkLayers, FewerLayersThanTheThresholdAreDropped) {
  EXPECT_TRUE(link_layers(Quadrant::kB, kerb(4.0, 2), kHeight, {}).empty());
  EXPECT_TRUE(link_layers(Quadrant::kB, {}, kHeight, {}).empty());
}

TEST(LinkLayers, ObstaclesChainAmongThemselves) {
  auto feet = kerb(4.0, 8);
  for (std::size_t r = 4; r < 8; ++r) feet[r].obstacle = true;
  const auto chains = link_layers(Quadrant::kB, feet, kHeight, {});
  ASSERT_EQ(chains.size(), 2U);
  EXPECT_NE(chains[0].obstacle, chains[1].obstacle);
}

std::vector<Chain> left_side(const std::vector<Candidate>& front, const std::vector<Candidate>& rear) {
  auto chains = link_layers(Quadrant::kB, front, kHeight, {});
  for (Chain& chain : link_layers(Quadrant::kD, rear, kHeight, {})) chains.push_back(chain);
  return chains;
}

TEST(Join, FrontAndRearOfOneKerbAreOneStrandFromRearToFront) {
  const auto strands = join_front_and_rear(left_side(kerb(2.5, 6), kerb(2.5, 6, -1.0)), false, kHeight, {});
  ASSERT_EQ(strands.size(), 1U);
  ASSERT_EQ(strands[0].points.size(), 12U);
  EXPECT_LT(strands[0].points.front().foot.x, 0.0);
  EXPECT_GT(strands[0].points.back().foot.x, 0.0);
  for (std::size_t i = 0; i < strands[0].bridged.size(); ++i) EXPECT_EQ(strands[0].bridged[i], i == 5);
}

TEST(LinkLayers, FarOutRingsLieWideApartButKerbsDoNotJump) {
  const auto far = [](std::size_t ring, double x) {
    return Candidate{ring, deg_to_rad(-8.0 + 2.0 * static_cast<double>(ring)), {x, 4.0, 0.0}, 0.12, false};
  };
  std::vector<Candidate> feet{far(0, 15.0), far(1, 21.0), far(2, 30.0)};
  EXPECT_EQ(link_layers(Quadrant::kB, feet, kHeight, {}).size(), 1U);
  feet.back().foot.x = 32.0;
  EXPECT_TRUE(link_layers(Quadrant::kB, feet, kHeight, {}).empty());
}

TEST(Join, ParallelKerbsStayApart) {
  EXPECT_EQ(join_front_and_rear(left_side(kerb(2.5, 6), kerb(5.0, 6, -1.0)), false, kHeight, {}).size(), 2U);
}

/// A chain along the left side from x on, away from the vehicle.
Chain chain_from(double x, double y) {
  Chain chain{x > 0.0 ? Quadrant::kB : Quadrant::kD, false, {}};
  for (std::size_t r = 0; r < 6; ++r)
    chain.points.push_back(at(r, x + (x > 0.0 ? 0.4 : -0.4) * static_cast<double>(r), y));
  return chain;
}

// Found on a real scan whose mirror image joined otherwise: the chain that was looked at first took the
// other.
TEST(Join, TheNearestPairJoinsWhicheverIsAheadAndWhicheverBehind) {
  for (const double ahead : {1.0, -1.0}) {
    const std::vector<Chain> chains{chain_from(ahead * 3.0, 2.5), chain_from(ahead * 2.0, 2.6),
                                    chain_from(ahead * -2.0, 2.5)};
    const auto strands = join_front_and_rear(chains, false, kHeight, {});
    ASSERT_EQ(strands.size(), 2U);
    ASSERT_EQ(strands[0].points.size(), 12U);
    const std::vector<Candidate>& joined = strands[0].points;
    EXPECT_EQ(std::max(joined.front().foot.y, joined.back().foot.y), 2.6);
  }
}

/// Where scan lines of a level scanner meet a straight kerb at y, from ring `first` on.
std::vector<Candidate> crossings(double y, std::size_t first, double ahead) {
  std::vector<Candidate> feet;
  for (std::size_t r = first; r < first + 6; ++r) {
    const double range = kHeight / std::tan(-at(r, 0.0, 0.0).elevation_rad);
    feet.push_back(at(r, ahead * std::sqrt(range * range - y * y), y));
  }
  return feet;
}

// Found on a road of 13 m: the far kerb had a gap of 12 m abreast, where two scan lines just touch it.
TEST(Join, AKerbFarAsideIsBridgedHoweverWideTheGapThatScanLinesLeave) {
  const auto chains = left_side(crossings(8.5, 9, 1.0), crossings(8.5, 9, -1.0));
  EXPECT_GT(distance(chains[0].points[0].foot.xy(), chains[1].points[0].foot.xy()), 9.0);
  EXPECT_EQ(join_front_and_rear(chains, false, kHeight, {}).size(), 1U);
}

TEST(Join, WhereScanLinesRunThroughBetweenThereIsAnOpening) {
  const auto chains = left_side(crossings(2.5, 4, 1.0), crossings(2.5, 4, -1.0));
  EXPECT_LT(distance(chains[0].points[0].foot.xy(), chains[1].points[0].foot.xy()), 13.0);
  EXPECT_EQ(join_front_and_rear(chains, false, kHeight, {}).size(), 2U);
}

TEST(Join, TheOtherSideIsNotLookedAt) {
  EXPECT_TRUE(join_front_and_rear(left_side(kerb(2.5, 6), {}), true, kHeight, {}).empty());
}

TEST(Join, AShortObstacleIsAVehicleAndALongOneAWall) {
  const auto obstacle = [](std::size_t rings) {
    auto feet = kerb(4.0, rings);
    for (Candidate& c : feet) c.obstacle = true;
    return left_side(feet, {});
  };
  EXPECT_TRUE(join_front_and_rear(obstacle(8), false, kHeight, {}).empty());  // 2.8 m
  const auto walls = join_front_and_rear(obstacle(16), false, kHeight, {});   // 6 m
  ASSERT_EQ(walls.size(), 1U);
  EXPECT_TRUE(walls[0].obstacle);
}

}  // namespace
}  // namespace verge::detect::gradient
