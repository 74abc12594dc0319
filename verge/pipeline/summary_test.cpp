// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/pipeline/summary.hpp"

#include <algorithm>

#include <gmock/gmock.h>
#include <rapidcheck/gtest.h>

namespace verge::pipeline {
namespace {

TEST(Percentile, nearest_rank_on_a_small_set) {
  const std::vector<double> values{15, 20, 35, 40, 50};
  EXPECT_EQ(percentile(values, 0.05), 15);
  EXPECT_EQ(percentile(values, 0.30), 20);
  EXPECT_EQ(percentile(values, 0.40), 20);
  EXPECT_EQ(percentile(values, 0.50), 35);
  EXPECT_EQ(percentile(values, 1.00), 50);
}

TEST(Percentile, of_nothing_is_none) { EXPECT_EQ(percentile({}, 0.5), std::nullopt); }

RC_GTEST_PROP(Percentile, is_a_value_and_at_least_that_share_does_not_exceed_it, ()) {
  const auto whole = *rc::gen::nonEmpty(rc::gen::container<std::vector<int>>(rc::gen::inRange(-50, 50)));
  const double p = *rc::gen::inRange(1, 101) / 100.0;
  const std::vector<double> values(whole.begin(), whole.end());
  const double found = percentile(values, p).value();
  const auto share = [&](auto&& test) {
    return static_cast<double>(std::count_if(values.begin(), values.end(), test)) /
           static_cast<double>(values.size());
  };
  RC_ASSERT(std::find(values.begin(), values.end(), found) != values.end());
  RC_ASSERT(share([&](double v) { return v <= found; }) >= p);
  RC_ASSERT(share([&](double v) { return v < found; }) < p);
}

}  // namespace
}  // namespace verge::pipeline
