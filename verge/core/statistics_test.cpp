// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/core/statistics.hpp"

#include <algorithm>
#include <vector>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "verge/core/round_length.hpp"

namespace verge {
namespace {

TEST(Statistics, MedianIsTheMiddleValueOrTheMeanOfTheMiddleTwo) {
  EXPECT_DOUBLE_EQ(median(std::vector<double>{5.0, 1.0, 3.0}).value(), 3.0);
  EXPECT_DOUBLE_EQ(median(std::vector<double>{5.0, 1.0, 3.0, 4.0}).value(), 3.5);
  EXPECT_DOUBLE_EQ(median(std::vector<double>{-2.0}).value(), -2.0);
}

TEST(Statistics, PercentileInterpolatesBetweenOrderStatistics) {
  const std::vector<double> v{15.0, 20.0, 35.0, 40.0, 50.0};
  EXPECT_DOUBLE_EQ(percentile(v, 0.0).value(), 15.0);
  EXPECT_DOUBLE_EQ(percentile(v, 40.0).value(), 29.0);  // position 1.6
  EXPECT_DOUBLE_EQ(percentile(v, 95.0).value(), 48.0);  // position 3.8
  EXPECT_DOUBLE_EQ(percentile(v, 100.0).value(), 50.0);
}

TEST(Statistics, MeanIsTheSumOverTheNumber) {
  EXPECT_DOUBLE_EQ(mean(std::vector<double>{1.0, 2.0, 6.0}).value(), 3.0);
}

TEST(Statistics, NoValuesGiveNone) {
  EXPECT_FALSE(median({}).has_value());
  EXPECT_FALSE(percentile({}, 95.0).has_value());
  EXPECT_FALSE(mean({}).has_value());
}

RC_GTEST_PROP(Statistics, PercentileAgreesWithSorting, (const std::vector<std::int16_t>& raw, bool high)) {
  RC_PRE(!raw.empty());
  std::vector<double> v(raw.begin(), raw.end());
  const double percent = high ? 95.0 : 37.5;
  const double got = percentile(v, percent).value();
  std::sort(v.begin(), v.end());
  const double position = static_cast<double>(v.size() - 1) * percent / 100.0;
  const auto k = static_cast<std::size_t>(position);
  const double above = v[std::min(k + 1, v.size() - 1)];
  const double expected =
      v[k] * (1.0 - (position - static_cast<double>(k))) + above * (position - static_cast<double>(k));
  RC_ASSERT(std::abs(got - expected) < 1e-9);
}

TEST(RoundLength, IsTheGreatestRoundOneNotAbove) {
  EXPECT_EQ(round_length(15.0), 10.0);
  EXPECT_EQ(round_length(10.0), 10.0);
  EXPECT_EQ(round_length(0.4), 0.2);
  EXPECT_EQ(round_length(999.0), 500.0);
  EXPECT_EQ(round_length(2.0), 2.0);
}

}  // namespace
}  // namespace verge
