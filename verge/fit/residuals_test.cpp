// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/fit/residuals.hpp"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

namespace verge::fit {
namespace {

TEST(Residuals, RmsIsWeightedAndThePercentileCountsEachPointThatWeighsAnythingOnce) {
  const Residuals r = summarise({3.0, -4.0, 100.0}, std::vector<double>{4.0, 1.0, 0.0});
  EXPECT_DOUBLE_EQ(r.rms_m, std::sqrt((4.0 * 9.0 + 16.0) / 5.0));
  EXPECT_DOUBLE_EQ(r.p95_m, 3.95);
  EXPECT_EQ(r.signed_m, (std::vector<double>{3.0, -4.0, 100.0}));
}

TEST(Residuals, NoWeightsCountEveryPoint) {
  const Residuals r = summarise({3.0, -4.0}, {});
  EXPECT_DOUBLE_EQ(r.rms_m, std::sqrt(12.5));
  EXPECT_EQ(weights_or_ones({}, 2), (std::vector<double>{1.0, 1.0}));
  EXPECT_EQ(weights_or_ones(std::vector<double>{5.0}, 1), (std::vector<double>{5.0}));
}

}  // namespace
}  // namespace verge::fit
