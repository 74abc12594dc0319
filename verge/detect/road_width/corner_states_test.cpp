// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/detect/road_width/corner_states.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include "verge/detect/road_width/layer_geometry.hpp"

namespace verge::detect::road_width {
namespace {

constexpr double kRoad_m = 5.0;
constexpr double kSideRoad_m = 5.0;
constexpr double kOpen_m = 5.5;  // how much longer a line is where one side is open
constexpr std::size_t kNever = std::numeric_limits<std::size_t>::max();

/// Length of a line that is s beyond where the kerb begins to turn into a side road, by an arc of radius r at
/// each of its corners.
double length_m(double s, double r) {
  const double from_arc = std::min(s, 2.0 * r + kSideRoad_m - s);  // the other corner is the mirror image
  if (from_arc <= 0.0) return kRoad_m;
  if (from_arc >= r) return kRoad_m + kOpen_m;
  return kRoad_m + std::min(kOpen_m, r - std::sqrt(r * r - from_arc * from_arc));
}

/// The steps of a drive past the side road; the first line reaches it in step 0, the last one d_l later.
std::vector<CornerStep> drive_past(double r, double kmh, std::size_t lag,
                                   const CornerThresholds& thresholds) {
  const double way_m = kmh / 3.6 / 20.0;  // d_v
  const double behind_m = LayerGeometry{}.first_to_last_m();
  CornerStates states(thresholds);
  std::vector<CornerStep> steps;
  for (int t = -30; way_m * t < 2.0 * r + kSideRoad_m + 5.0; ++t) {
    const CornerStep step = states.step({length_m(way_m * t, r), length_m(way_m * t - behind_m, r)}, lag);
    if (t >= 0) steps.push_back(step);
  }
  return steps;
}

std::size_t most_k(double kmh, std::size_t lag) {
  std::size_t most = 0;
  for (const CornerStep& step : drive_past(0.5, kmh, lag, {.k = kNever})) most = std::max(most, step.k);
  return most;
}

std::size_t found_after(double r, double kmh) {
  const auto steps = drive_past(r, kmh, 8, {});
  const auto found = std::find_if(steps.begin(), steps.end(), [](const CornerStep& s) { return s.found; });
  return static_cast<std::size_t>(found - steps.begin());
}

}  // namespace

// K cannot outgrow the lag, because then the history is in the corner too, nor the scans in the opening.
TEST(CornerStates, KSaturatesByLagAndBySpeed) {
  for (const std::size_t lag : {1U, 2U, 3U, 5U, 8U, 12U, 20U}) {
    EXPECT_EQ(most_k(10.0, lag), lag) << lag;
    EXPECT_EQ(most_k(30.0, lag), std::min<std::size_t>(lag, 12)) << lag;
    EXPECT_EQ(most_k(60.0, lag), std::min<std::size_t>(lag, 6)) << lag;
  }
}

// Scans after the first line begins to widen, for corners of small, moderate and large radius.
TEST(CornerStates, FindsACornerAfterItsDelay) {
  EXPECT_EQ(found_after(0.5, 10.0), 6U);
  EXPECT_EQ(found_after(0.5, 30.0), 4U);
  EXPECT_EQ(found_after(0.5, 60.0), 3U);
  EXPECT_EQ(found_after(3.0, 10.0), 21U);
  EXPECT_EQ(found_after(3.0, 30.0), 9U);
  EXPECT_EQ(found_after(3.0, 60.0), 6U);
  EXPECT_EQ(found_after(8.0, 10.0), 46U);
  EXPECT_EQ(found_after(8.0, 30.0), 17U);
  EXPECT_EQ(found_after(8.0, 60.0), 10U);
}

TEST(CornerStates, FindsEachCornerOnce) {
  for (const double kmh : {10.0, 30.0, 60.0}) {
    const auto steps = drive_past(0.5, kmh, 8, {});
    EXPECT_EQ(std::count_if(steps.begin(), steps.end(), [](const CornerStep& s) { return s.found; }), 1)
        << kmh;
  }
}

TEST(CornerStates, FindsNothingOnAStraightRoadOrWhereAllLinesWidenAtOnce) {
  CornerStates states({});
  for (int t = 0; t < 50; ++t) {
    const double length = t < 25 ? 5.0 : 12.0;
    const CornerStep step = states.step({length, length}, 8);
    EXPECT_FALSE(step.candidate || step.found) << t;
  }
}

// One bad scan ends the paper's state; with a miss allowed it does not.
TEST(CornerStates, AMissEndsTheStateUnlessItIsAllowed) {
  for (const std::size_t misses : {0U, 1U}) {
    CornerStates states({.k = 3, .misses = misses});
    bool found = false;
    for (int t = 0; t < 8; ++t) states.step({5.0, 5.0}, 8);
    for (int t = 0; t < 5; ++t) found = states.step({t == 2 ? 5.0 : 10.0, 5.0}, 8).found || found;
    EXPECT_EQ(found, misses == 1) << misses;
  }
}

TEST(CornerStates, TakeTheBeginOfAShortHistory) {
  CornerStates states({.k = 0});
  EXPECT_FALSE(states.step({10.0, 5.0}, 8).found);  // nothing to compare with
  EXPECT_FALSE(states.step({10.5, 5.0}, 8).found);
  EXPECT_TRUE(states.step({11.5, 5.0}, 8).found);
}

TEST(CornerStates, SayWhenTheFirstLineLeaves) {
  std::size_t found = 0;
  std::size_t left = 0;
  for (const CornerStep& step : drive_past(0.5, 30.0, 8, {})) {
    found += step.found ? 1U : 0U;
    left += step.left ? 1U : 0U;
    EXPECT_GE(found, left) << "none is left before it is found";
  }
  EXPECT_EQ(found, 1U);
  EXPECT_EQ(left, 1U);
}

TEST(CornerStates, RestForSoMuchWay) {
  for (const double rest_m : {0.0, 5.0}) {
    CornerStates states({.k = 0, .rest_m = rest_m});
    std::size_t found = 0;
    const auto drive = [&](double way_m, double first_m) {
      found += states.step({first_m, 5.0, way_m}, 1).found ? 1U : 0U;
    };
    drive(1.0, 5.0);
    drive(2.0, 8.0);  // a corner
    drive(3.0, 5.0);
    drive(4.0, 8.0);  // and another, 2 m on
    EXPECT_EQ(found, rest_m == 0.0 ? 2U : 1U) << rest_m;
    drive(7.5, 5.0);
    drive(8.5, 8.0);
    EXPECT_EQ(found, rest_m == 0.0 ? 3U : 2U) << rest_m;
  }
}

}  // namespace verge::detect::road_width
