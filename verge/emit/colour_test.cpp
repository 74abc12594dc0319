// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/emit/colour.hpp"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace verge::emit {
namespace {

/// CIE lightness of an sRGB colour, 0 (black) to 100 (white).
double lightness(Colour c) {
  const auto linear = [](double v) { return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4); };
  const double y = 0.2126 * linear(c.red) + 0.7152 * linear(c.green) + 0.0722 * linear(c.blue);
  return 116.0 * std::cbrt(y) - 16.0;
}

TEST(Rgb, SplitsAHexadecimalColour) {
  EXPECT_EQ(rgb(0xFF0080), (Colour{1.0, 0.0, 128.0 / 255.0, 1.0}));
  EXPECT_EQ(rgb(0xFFFFFF, 0.5).faded(0.5).alpha, 0.25);
}

TEST(HeightColour, EqualStepsOfHeightAreEqualStepsOfLightness) {
  constexpr int kSteps = 16;
  const double whole = lightness(height_colour(1.0)) - lightness(height_colour(0.0));
  EXPECT_GT(whole, 60.0);
  for (int i = 0; i < kSteps; ++i) {
    const double step =
        lightness(height_colour((i + 1.0) / kSteps)) - lightness(height_colour(1.0 * i / kSteps));
    EXPECT_NEAR(step, whole / kSteps, 0.35 * whole / kSteps) << i;
  }
}

TEST(HeightColour, OutsideTheScaleTheNearerEndCounts) {
  EXPECT_EQ(height_colour(-3.0), height_colour(0.0));
  EXPECT_EQ(height_colour(7.0), height_colour(1.0));
}

TEST(GroupColour, NeighboursDifferAndAnyNumberHasOne) {
  for (int group = -9; group < 9; ++group) EXPECT_NE(group_colour(group), group_colour(group + 1));
  EXPECT_EQ(group_colour(-8), group_colour(0));
  EXPECT_EQ(group_colour(std::numeric_limits<int>::min()), group_colour(0));
}

}  // namespace
}  // namespace verge::emit
