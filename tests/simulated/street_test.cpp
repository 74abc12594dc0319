// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0

// Road edges, cars and people on paper 2's street, against the simulator's truth: its drives beyond those
// that docs/results.md reports.
#include <atomic>
#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include <gtest/gtest.h>

#include "verge/study/contestant.hpp"
#include "verge/study/figures.hpp"
#include "verge/study/parts.hpp"
#include "verge/study/suite.hpp"

namespace verge::study {
namespace {

constexpr std::uint64_t kFirst = 1001;
constexpr std::uint64_t kLast = 1008;

/// What a method came to in that cell of the suite.
Figures figures_in(std::size_t cell, const std::string& method) {
  static const Suite suite = suite_named("paper2", {});
  const Contestant contestant = contestant_of(method);
  const std::vector<const Contestant*> contestants{&contestant};
  const std::atomic<bool> stop{false};
  const PartHooks hooks{stop, [] {}, [](const std::string& text) { ADD_FAILURE() << text; }};
  Tally sum;
  for (std::uint64_t drive = kFirst; drive <= kLast; ++drive)
    sum += judge_drive(suite, suite.cells[cell], drive, contestants, hooks)->front();
  return figures_of(suite, contestant, sum);
}

double value_in(const Figures& figures, const char* name) {
  const auto value = value_of(figures, name);
  EXPECT_TRUE(value) << name;
  return value.value_or(-1.0);
}

constexpr std::size_t kParked = 0;
constexpr std::size_t kClear = 1;

}  // namespace

TEST(Street, EdgesAreFoundWhereParkedCarsShowThem) {
  const Figures figures = figures_in(kParked, "line_fit");
  EXPECT_GE(value_in(figures, "precision"), 0.95);
  EXPECT_GE(value_in(figures, "recall"), 0.95);
  EXPECT_LE(value_in(figures, "lateral_p95_m"), 0.2);
}

TEST(Street, CarsAreFoundWithTheirHeadingsAndSizesAndToldFromPeople) {
  const Figures figures = figures_in(kParked, "line_fit");
  EXPECT_GE(value_in(figures, "two_faced_cars_true"), 100.0);
  EXPECT_LE(value_in(figures, "cars_heading_p95_deg"), 3.0);
  EXPECT_GE(value_in(figures, "two_faced_cars_iou_above_0.7"), 0.95);
  EXPECT_GE(value_in(figures, "car_f1"), 0.95);
  EXPECT_GE(value_in(figures, "person_f1"), 0.9);  // some twenty people: one is five per cent
}

// P2 V-B: "Line obtained by using these methods located far from the object of interest", of all points at
// once; of the kerb's returns alone the same lines are as good as any.
TEST(Street, LinesThroughAllPointsAtOnceAreNoEdgesAndLinesThroughTheKerbsAre) {
  for (const std::string estimator : {"least_squares", "theil_sen"}) {
    const Figures all = figures_in(kClear, "line_fit:grouping=none,estimator=" + estimator);
    const Figures kerbs = figures_in(kClear, "line_fit:estimator=" + estimator);
    EXPECT_LT(value_in(all, "recall"), 0.05) << estimator;
    EXPECT_GT(value_in(kerbs, "recall"), 0.95) << estimator;
  }
}

// P2 VI: "Hough line detection works well", with gaps.
TEST(Street, HoughLinesThroughAllPointsAreRightAndHaveGaps) {
  const Figures figures = figures_in(kClear, "line_fit:grouping=none,estimator=hough");
  EXPECT_GT(value_in(figures, "precision"), 0.9);
  EXPECT_LT(value_in(figures, "recall"), 0.7);
}

}  // namespace verge::study
