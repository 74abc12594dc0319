// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/core/angle.hpp"

#include <algorithm>
#include <limits>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace verge {
namespace {

TEST(WrapPi, KeepsTheDirectionAndTheInterval) {
  EXPECT_DOUBLE_EQ(wrap_pi(0.0), 0.0);
  EXPECT_DOUBLE_EQ(wrap_pi(std::numbers::pi), -std::numbers::pi);
  EXPECT_DOUBLE_EQ(wrap_pi(-std::numbers::pi), -std::numbers::pi);
  EXPECT_NEAR(wrap_pi(7.0), 7.0 - 2.0 * std::numbers::pi, 1e-15);
  EXPECT_TRUE(std::isnan(wrap_pi(std::numeric_limits<double>::infinity())));
}

RC_GTEST_PROP(WrapPi, IsIdempotentAndBounded, (int milli)) {
  const double wrapped = wrap_pi(milli * 1e-3);
  RC_ASSERT(wrapped >= -std::numbers::pi && wrapped < std::numbers::pi);
  RC_ASSERT(std::abs(wrap_pi(wrapped) - wrapped) < 1e-15);
}

TEST(FastAtan2, StaysWithinItsErrorAllAround) {
  double worst = 0.0;
  for (int i = -31416; i <= 31416; ++i) {
    for (const double radius : {1e-3, 1.0, 7.3, 250.0}) {
      const auto x = static_cast<float>(radius * std::cos(i * 1e-4));
      const auto y = static_cast<float>(radius * std::sin(i * 1e-4));
      const double exact = std::atan2(static_cast<double>(y), static_cast<double>(x));
      worst = std::max(worst, std::abs(static_cast<double>(fast_atan2(y, x)) - exact));
    }
  }
  EXPECT_LT(worst, static_cast<double>(kFastAtan2Error));
}

TEST(FastAtan2, DegenerateInputs) {
  EXPECT_EQ(fast_atan2(0.0F, 0.0F), 0.0F);
  EXPECT_FLOAT_EQ(fast_atan2(0.0F, -1.0F), std::numbers::pi_v<float>);
  EXPECT_FLOAT_EQ(fast_atan2(1.0F, 0.0F), std::numbers::pi_v<float> / 2);
  EXPECT_TRUE(std::isnan(fast_atan2(std::numeric_limits<float>::quiet_NaN(), 1.0F)));
  EXPECT_TRUE(std::isnan(fast_atan2(1.0F, std::numeric_limits<float>::infinity())));
}

}  // namespace
}  // namespace verge
