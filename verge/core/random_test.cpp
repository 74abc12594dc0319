// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/core/random.hpp"

#include <array>
#include <cstdint>

#include <gtest/gtest.h>

namespace verge {
namespace {

TEST(Random, IsSplitMix64) {
  RandomSequence random(1234567);  // the five numbers that its authors' C code gives for this seed
  for (const std::uint64_t expected : {6457827717110365317ULL, 3203168211198807973ULL, 9817491932198370423ULL,
                                       4593380528125082431ULL, 16408922859458223821ULL}) {
    EXPECT_EQ(random.next(), expected);
  }
}

TEST(Random, PicksEachOfAFewAboutEquallyOftenAndNoOther) {
  RandomSequence random(1);
  std::array<int, 7> counts{};
  for (int i = 0; i < 70'000; ++i) ++counts.at(random.below(7));
  for (const int count : counts) EXPECT_NEAR(count, 10'000, 400);  // 4.3 standard deviations
}

TEST(Random, UniformNumbersFillTheUnitIntervalEvenly) {
  RandomSequence random(2);
  std::array<int, 10> counts{};
  for (int i = 0; i < 100'000; ++i) ++counts.at(static_cast<std::size_t>(10.0 * random.uniform()));
  for (const int count : counts) EXPECT_NEAR(count, 10'000, 400);
}

}  // namespace
}  // namespace verge
