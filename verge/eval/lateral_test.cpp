// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/eval/lateral.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "verge/eval/frame_success.hpp"
#include "verge/eval/run_time.hpp"
#include "verge/eval/stations.hpp"
#include "verge/eval/test_scenes.hpp"

namespace verge::eval {
namespace {

using testing::along_x;
using testing::mirrored;
using testing::road;
using testing::scene_of;

// ---- Lateral errors

TEST(Lateral, TheSignOfTheMedianSaysTooWideOrTooNarrow) {
  const auto summary = [](double left, double right) {
    return summarise(lateral_errors(match_boundaries(road(left, right), road(4.0, -4.0)), 20.0));
  };
  EXPECT_NEAR(*summary(4.1, -4.1).median_m, 0.1, 1e-12);
  EXPECT_NEAR(*summary(3.9, -3.9).median_m, -0.1, 1e-12);
  EXPECT_NEAR(*summary(3.9, -4.1).rmse_m, 0.1, 1e-12);
  EXPECT_NEAR(*summary(3.9, -4.1).percentile_95_m, 0.1, 1e-12);
  EXPECT_NEAR(*summary(3.9, -4.1).mean_heading_rad, 0.0, 1e-12);
}

TEST(Lateral, WhatIsAMetreAwayIsNoMatch) {
  const SceneMatch match = match_boundaries(road(5.1, -4.0), road(4.0, -4.0));
  for (const LateralError& error : lateral_errors(match, 20.0)) EXPECT_NEAR(error.outward_m, 0.0, 1e-12);
  EXPECT_FALSE(summarise({}).median_m.has_value());
}

TEST(Lateral, BinsAreRingsAroundTheSensor) {
  Scene found = scene_of({along_x(Side::kLeft, 4.0, 0.0, 9.0), along_x(Side::kLeft, 4.2, 10.0, 15.0)});
  const auto bins = summarise_by_range(
      lateral_errors(match_boundaries(found, scene_of({along_x(Side::kLeft, 4.0, 0.0, 30.0)})), 40.0), 10.0);
  ASSERT_EQ(bins.size(), 2U);
  EXPECT_NEAR(*bins[0].rmse_m, 0.0, 1e-12);
  EXPECT_NEAR(*bins[1].rmse_m, 0.2, 1e-12);
}

TEST(LineDistances, OfParallelLinesAreTheirDistance) {
  const LineDistances apart = line_distances(match_boundaries(road(4.3, -4.3), road(4.0, -4.0)), 20.0);
  EXPECT_NEAR(*apart.hausdorff_95_m, 0.3, 1e-12);
  EXPECT_NEAR(*apart.chamfer_m, 0.3, 1e-12);
}

TEST(LineDistances, AMissingHalfIsSeenFromTheTruth) {
  // The truth runs 10 m on past the end of the prediction: its directed distances are 0 over the half, then
  // 0..10.
  const SceneMatch match = match_boundaries(scene_of({along_x(Side::kLeft, 0.0, 0.0, 10.0)}),
                                            scene_of({along_x(Side::kLeft, 0.0, 0.0, 20.0)}));
  const LineDistances apart = line_distances(match, 50.0);
  EXPECT_NEAR(*apart.hausdorff_95_m, 9.0, 0.05);
  EXPECT_NEAR(*apart.chamfer_m, 0.5 * 2.5, 0.02);
  EXPECT_FALSE(line_distances(match_boundaries(Scene{}, road(4.0, -4.0)), 20.0).chamfer_m.has_value());
}

// ---- Stations

TEST(Stations, LateralIsReadBetweenThePoints) {
  Boundary bent;
  bent.side = Side::kLeft;
  bent.points = {{0.0, 4.0, 0.0}, {10.0, 6.0, 0.0}};
  EXPECT_NEAR(*lateral_at(scene_of({bent}), Side::kLeft, 5.0), 5.0, 1e-12);
  EXPECT_FALSE(lateral_at(scene_of({bent}), Side::kLeft, 10.1).has_value());
  EXPECT_FALSE(lateral_at(scene_of({bent}), Side::kRight, 5.0).has_value());
  EXPECT_EQ(lateral_at(scene_of({bent, along_x(Side::kLeft, 3.0, 0.0, 9.0)}), Side::kLeft, 5.0), 3.0);
}

TEST(Stations, EachOneIsCountedOnce) {
  // Stations 0, 0.2, ..., 19.8. Truth: left to 10 m, right to 20 m. Found: left to 15 m, right from 5 m, 0.4
  // m off.
  const Scene truth =
      scene_of({along_x(Side::kLeft, 4.0, 0.0, 10.1), along_x(Side::kRight, -4.0, 0.0, 20.1)});
  const Scene found =
      scene_of({along_x(Side::kLeft, 4.1, 0.0, 15.1), along_x(Side::kRight, -4.4, 4.9, 20.1)});
  const auto stations = count_stations(found, truth);
  ASSERT_EQ(stations.size(), 100U);
  const StationCounts all = pooled(stations);
  EXPECT_EQ(all.right, 51U);
  EXPECT_EQ(all.extra, 25U);
  EXPECT_EQ(all.both_absent, 24U);
  EXPECT_EQ(all.wrong, 75U);
  EXPECT_EQ(all.missed, 25U);
  EXPECT_DOUBLE_EQ(*all.precision(), 51.0 / 151.0);
  EXPECT_DOUBLE_EQ(*all.precision_inside(), 51.0 / 126.0);
  EXPECT_DOUBLE_EQ(*all.recall(), 51.0 / 76.0);
  EXPECT_NEAR(*all.mean_error_m(), (51 * 0.1 + 75 * 0.4) / 126.0, 1e-12);
  EXPECT_EQ(pooled(count_stations(mirrored(found), mirrored(truth))), all);
}

TEST(Stations, ScansAddUp) {
  const Scene scene = road(4.0, -4.0);
  std::vector<StationCounts> sum;
  add_stations(sum, count_stations(scene, scene));
  add_stations(sum, count_stations(Scene{}, scene));
  EXPECT_EQ(sum[0], (StationCounts{0, 2, 0, 2, 0, 0.0}));
}

// ---- Success

std::optional<Deviation> deviation(const Scene& found) {
  return deviation_of(match_boundaries(found, road(4.0, -4.0)));
}

TEST(Deviation, DependsOnHowFarTheWorstAndTheBulkAreOff) {
  EXPECT_EQ(deviation(road(4.15, -4.0)), Deviation::kMinimum);
  EXPECT_EQ(deviation(road(4.4, -4.0)), Deviation::kLarger);
  EXPECT_EQ(deviation(road(4.6, -4.0)), Deviation::kFailed);
  Scene one_side = road(4.0, -4.0);
  one_side.boundaries.pop_back();
  EXPECT_EQ(deviation(one_side), Deviation::kFailed);
  EXPECT_FALSE(deviation_of(match_boundaries(road(4.0, -4.0), Scene{})).has_value());
}

TEST(Deviation, AStraySampleSpoilsAScan) {
  Scene stray = road(4.0, -4.0);
  stray.boundaries.push_back(along_x(Side::kLeft, 4.7, 0.0, 0.2));
  EXPECT_EQ(deviation(stray), Deviation::kLarger);
  stray.boundaries.push_back(along_x(Side::kLeft, 5.2, 0.0, 0.2));
  EXPECT_EQ(deviation(stray), Deviation::kFailed);
}

TEST(Deviation, WhatIsHiddenNeedNotBeFound) {
  Scene truth = road(4.0, -4.0);
  truth.boundaries[1].state = {PointState::kOccluded, PointState::kOccluded};
  Scene one_side = road(4.0, -4.0);
  one_side.boundaries.pop_back();
  EXPECT_EQ(deviation_of(match_boundaries(one_side, truth)), Deviation::kMinimum);
}

TEST(WilsonInterval, HasTheKnownValues) {
  // 96 of 100: 0.9016 to 0.9843; 0 of 10: 0 to 0.2775 (closed form z^2 / (n + z^2)).
  const auto many = wilson_interval(96, 100);
  EXPECT_NEAR(many->low, 0.9016, 5e-5);
  EXPECT_NEAR(many->high, 0.9843, 5e-5);
  const auto none = wilson_interval(0, 10);
  EXPECT_EQ(none->low, 0.0);
  EXPECT_NEAR(none->high, 1.959964 * 1.959964 / (10.0 + 1.959964 * 1.959964), 1e-12);
  EXPECT_FALSE(wilson_interval(0, 0).has_value());
}

TEST(SuccessCounts, MinimumAndLargerAreSuccesses) {
  SuccessCounts counts;
  counts.count(Deviation::kMinimum);
  counts.count(Deviation::kLarger);
  counts.count(Deviation::kFailed);
  SuccessCounts twice = counts;
  twice += counts;
  EXPECT_EQ(twice.successes(), 4U);
  EXPECT_EQ(twice.scans(), 6U);
}

// ---- Run time

TEST(RunTime, ArePercentilesOfTheScans) {
  std::vector<double> seconds;
  for (int i = 0; i <= 100; ++i) seconds.push_back(0.001 * i);
  const RunTime times = summarise_run_time(seconds);
  EXPECT_EQ(times.scans, 101U);
  EXPECT_NEAR(*times.median_s, 0.050, 1e-12);
  EXPECT_NEAR(*times.percentile_95_s, 0.095, 1e-12);
  EXPECT_NEAR(*times.percentile_99_s, 0.099, 1e-12);
  EXPECT_NEAR(*times.greatest_s, 0.100, 1e-12);
  EXPECT_FALSE(summarise_run_time({}).median_s.has_value());
}

}  // namespace
}  // namespace verge::eval
