// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/fit/banded.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace verge::fit {
namespace {

TEST(Banded, SolvesATridiagonalSystemByHand) {
  BandedMatrix a(3, 1);
  for (std::size_t i = 0; i < 3; ++i) a.at(i, i) = 2.0;
  a.at(0, 1) = a.at(1, 0) = a.at(1, 2) = a.at(2, 1) = -1.0;
  const auto x = solve(a, {{1.0, 0.0}, {0.0, 0.0}, {1.0, 4.0}}).value();
  EXPECT_NEAR(x[0].x, 1.0, 1e-14);
  EXPECT_NEAR(x[1].x, 1.0, 1e-14);
  EXPECT_NEAR(x[0].y, 1.0, 1e-14);
  EXPECT_NEAR(x[2].y, 3.0, 1e-14);
}

TEST(Banded, ASingularMatrixGivesNone) {
  BandedMatrix a(2, 1);
  a.at(0, 0) = a.at(0, 1) = a.at(1, 0) = a.at(1, 1) = 1.0;
  EXPECT_FALSE(solve(a, {{1.0, 1.0}, {1.0, 1.0}}).has_value());
  BandedMatrix rounded(2, 1);  // 0.3 / 0.1 is not quite 3: the last pivot comes out as 4e-16 and not as 0
  rounded.at(0, 0) = 0.1;
  rounded.at(0, 1) = 0.7;
  rounded.at(1, 0) = 0.3;
  rounded.at(1, 1) = 2.1;
  EXPECT_FALSE(solve(rounded, {{1.0, 1.0}, {1.0, 1.0}}).has_value());
  EXPECT_FALSE(solve(BandedMatrix(2, 0), {{1.0, 1.0}, {1.0, 1.0}}).has_value());
}

TEST(Banded, AnEntryThatIsNotANumberGivesNone) {
  BandedMatrix a(1, 0);
  a.at(0, 0) = std::nan("");
  EXPECT_FALSE(solve(a, {{1.0, 1.0}}).has_value());
}

}  // namespace
}  // namespace verge::fit
