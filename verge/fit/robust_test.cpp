// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/fit/robust.hpp"

#include <vector>

#include <gtest/gtest.h>

namespace verge::fit {
namespace {

TEST(Robust, ScaleIsTheMedianAbsoluteResidualInUnitsOfSigma) {
  const std::vector<double> r{-0.1, 0.2, -0.3, 0.4, 100.0};
  EXPECT_DOUBLE_EQ(robust_scale(r, {}, 0.0), 1.4826 * 0.3);
  EXPECT_DOUBLE_EQ(robust_scale(r, std::vector<double>{1.0, 1.0, 1.0, 0.0, 0.0}, 0.0), 1.4826 * 0.2);
}

TEST(Robust, ScaleHasAFloor) {
  EXPECT_DOUBLE_EQ(robust_scale(std::vector<double>{0.0, 0.0, 5.0}, {}, 1e-3), 1e-3);
  EXPECT_DOUBLE_EQ(robust_scale({}, {}, 1e-3), 1e-3);
}

TEST(Robust, TheBiweightIsOneAtTheCurveAndZeroBeyondItsReach) {
  const RobustOptions options{.tuning = 2.0, .scale_floor_m = 0.0};
  const std::vector<double> r{0.0, 1.0 / 1.4826, 1.0 / 1.4826, 1.9999, -2.0, 7.0};  // median 1.33, see below
  const double reach = 2.0 * robust_scale(r, {}, 0.0);
  const auto w = tukey_weights(r, {}, options);
  EXPECT_DOUBLE_EQ(w[0], 1.0);
  const double inside = 1.0 - (r[1] / reach) * (r[1] / reach);
  EXPECT_DOUBLE_EQ(w[1], inside * inside);
  EXPECT_DOUBLE_EQ(w[5], 0.0);
  EXPECT_GT(w[3], 0.0);
  EXPECT_LT(w[4], w[3]);  // the sign of a residual plays no part, its size does
}

TEST(Robust, WeightsMultiplyThePointsOwn) {
  const std::vector<double> r{0.0, 0.1, 0.1};
  const std::vector<double> own{3.0, 0.0, 1.0};
  EXPECT_DOUBLE_EQ(tukey_weights(r, own, {})[0], 3.0);
  EXPECT_DOUBLE_EQ(tukey_weights(r, own, {})[1], 0.0);
  EXPECT_DOUBLE_EQ(absolute_weights(r, own, {})[0], 3.0 / 1e-3);
  EXPECT_DOUBLE_EQ(absolute_weights(r, own, {})[2], 10.0);
}

TEST(Robust, TheBiweightFollowsTheStart) {
  const RobustOptions options{.start_iterations = 2};
  const std::vector<double> r{0.0, 0.1, 0.3};
  EXPECT_EQ(robust_weights(1, r, {}, options), absolute_weights(r, {}, options));
  EXPECT_EQ(robust_weights(2, r, {}, options), tukey_weights(r, {}, options));
}

}  // namespace
}  // namespace verge::fit
