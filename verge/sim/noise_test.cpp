// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/sim/noise.hpp"

#include <bit>
#include <cmath>
#include <set>

#include <gtest/gtest.h>

namespace verge::sim {
namespace {

constexpr std::uint64_t kSamples = 200'000;

TEST(Gaussian, HasMeanZeroAndDeviationOne) {
  double sum = 0.0;
  double squares = 0.0;
  for (std::uint64_t ray = 0; ray < kSamples; ++ray) {
    const double g = gaussian({1, 2, ray}, Draw::kRangeNoise);
    sum += g;
    squares += g * g;
  }
  const double n = static_cast<double>(kSamples);
  EXPECT_NEAR(sum / n, 0.0, 4.0 / std::sqrt(n));
  EXPECT_NEAR(std::sqrt(squares / n), 1.0, 4.0 / std::sqrt(2.0 * n));
}

TEST(Gaussian, HasTheNormalSharesWithinOneTwoAndThreeDeviations) {
  double within[3] = {0.0, 0.0, 0.0};
  for (std::uint64_t ray = 0; ray < kSamples; ++ray) {
    const double size = std::fabs(gaussian({9, 0, ray}, Draw::kRangeNoise));
    for (int k = 0; k < 3; ++k) within[k] += size < k + 1 ? 1.0 : 0.0;
  }
  const double n = static_cast<double>(kSamples);
  EXPECT_NEAR(within[0] / n, 0.682689, 0.005);
  EXPECT_NEAR(within[1] / n, 0.954500, 0.002);
  EXPECT_NEAR(within[2] / n, 0.997300, 0.0006);
}

TEST(Gaussian, NeighbouringRaysAndScansAreNotCorrelated) {
  double by_ray = 0.0;
  double by_scan = 0.0;
  for (std::uint64_t ray = 0; ray < kSamples; ++ray) {
    const double g = gaussian({1, 0, ray}, Draw::kRangeNoise);
    by_ray += g * gaussian({1, 0, ray + 1}, Draw::kRangeNoise);
    by_scan += g * gaussian({1, 1, ray}, Draw::kRangeNoise);
  }
  const double n = static_cast<double>(kSamples);
  EXPECT_NEAR(by_ray / n, 0.0, 4.0 / std::sqrt(n));
  EXPECT_NEAR(by_scan / n, 0.0, 4.0 / std::sqrt(n));
}

TEST(Uniform, FillsTheUnitIntervalEvenly) {
  int bins[10] = {};
  for (std::uint64_t ray = 0; ray < kSamples; ++ray) {
    const double u = uniform({3, 1, ray}, Draw::kDropout);
    ASSERT_GE(u, 0.0);
    ASSERT_LT(u, 1.0);
    ++bins[static_cast<int>(u * 10.0)];
  }
  for (const int count : bins) EXPECT_NEAR(count, 20'000, 4.0 * std::sqrt(20'000 * 0.9));
}

TEST(RandomBits, EveryPartOfTheKeyMatters) {
  std::set<std::uint64_t> seen;
  for (std::uint64_t a = 0; a < 8; ++a) {
    for (std::uint64_t b = 0; b < 8; ++b) {
      for (std::uint64_t c = 0; c < 8; ++c) {
        for (const Draw draw : {Draw::kRangeNoise, Draw::kDropout}) {
          seen.insert(random_bits({a, b, c}, draw, 0));
          seen.insert(random_bits({a, b, c}, draw, 1));
        }
      }
    }
  }
  EXPECT_EQ(seen.size(), 8U * 8U * 8U * 4U);
}

TEST(RandomBits, OneBitOfTheSeedTurnsHalfOfTheBits) {
  double turned = 0.0;
  for (int bit = 0; bit < 64; ++bit) {
    const std::uint64_t other = std::uint64_t{1} << static_cast<unsigned>(bit);
    turned +=
        std::popcount(random_bits({0, 5, 6}, Draw::kDropout) ^ random_bits({other, 5, 6}, Draw::kDropout));
  }
  EXPECT_NEAR(turned / 64.0, 32.0, 2.0);
}

}  // namespace
}  // namespace verge::sim
