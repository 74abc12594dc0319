// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0

// Corners along a whole drive past side roads, driveways, gaps and parked cars, against the simulator's
// truth.
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "verge/detect/registry.hpp"
#include "verge/eval/corner_score.hpp"
#include "verge/sim/drive.hpp"
#include "verge/sim/ready.hpp"
#include "verge/sim/sensors.hpp"

namespace verge {
namespace {

constexpr std::size_t kScans = 900;  // 375 m at 30 km/h

sim::DriveConfig config_of(const std::string& sensor, bool mirrored) {
  sim::DriveConfig config{.scenario = sim::ready_scenario("paper1-r3-v30"),
                          .sensor = sim::sensor_named(sensor),
                          .noise = {.seed = 5, .range_sigma_m = 0.03},
                          .truth_lines = false};
  if (mirrored) sim::mirror(config.scenario);
  return config;
}

/// A drive as seen, with what is true of it.
struct Seen {
  std::vector<Scan> scans;
  std::vector<Scene> truths;
};

Seen see(const sim::DriveConfig& config, std::size_t scans) {
  const sim::Drive drive(config);
  Seen seen;
  for (std::size_t i = 0; i < scans; ++i) {
    sim::Simulated simulated = drive.scan(i);
    seen.scans.push_back(deskew(std::move(simulated.scan)));
    seen.scans.back().mount = simulated.mount;
    seen.truths.push_back(std::move(simulated.truth));
  }
  return seen;
}

const Seen& usual_drive() {
  static const Seen seen = see(config_of("alasca_xt", false), kScans);
  return seen;
}

std::vector<Scene> detect_on(const std::vector<Scan>& scans, const std::vector<Setting>& settings) {
  const auto detector = detect::make("road_width", settings);
  std::vector<Scene> scenes;
  for (const Scan& scan : scans) scenes.push_back(detector->process(scan, nullptr));
  return scenes;
}

eval::CornerScore score(const Seen& seen, const std::vector<Scene>& scenes) {
  std::vector<eval::CornerFrame> frames;
  for (std::size_t i = 0; i < scenes.size(); ++i) frames.push_back({&scenes[i], &seen.truths[i], {}});
  return eval::score_corners(frames);
}

eval::CornerScore score_of(const Seen& seen, const std::vector<Setting>& settings) {
  return score(seen, detect_on(seen.scans, settings));
}

}  // namespace

TEST(Corners, AllTrueOnesAreFoundInTimeAndNoFalseOnes) {
  const auto found = score_of(usual_drive(), {});
  EXPECT_EQ(found.true_corners, 4U);
  EXPECT_EQ(found.detected, 4U);
  EXPECT_EQ(found.late, 0U);
  EXPECT_GE(found.false_presented, 7U);
  EXPECT_EQ(found.false_reported, 0U);
  EXPECT_EQ(found.false_reports, 0U);
  for (const double error_m : found.position_error_m) EXPECT_LT(error_m, 0.5);
}

TEST(Corners, SideAndExitAreThoseOfTheSideRoad) {
  const Seen& seen = usual_drive();
  const auto scenes = detect_on(seen.scans, {});
  std::size_t exits = 0;
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    for (const Corner& corner : scenes[i].corners) {
      ASSERT_TRUE(corner.distance_m && corner.sigma_m);
      EXPECT_GT(*corner.sigma_m, 0.0);
      for (const Corner& truth : seen.truths[i].corners) {
        if (truth.confidence == 0.0 || std::fabs(*truth.distance_m - *corner.distance_m) > 2.0) continue;
        EXPECT_EQ(corner.side, truth.side);
        if (!corner.exit_m) continue;
        ++exits;
        EXPECT_NEAR(*corner.exit_m, *truth.exit_m, 0.6) << "scan " << i;
        EXPECT_NEAR(*corner.width_m, *truth.width_m, 2.5);  // twice the error of the radius
      }
    }
  }
  EXPECT_GT(exits, 40U) << "each of the four is seen to end";
}

TEST(Corners, TheMirroredDriveHasTheMirroredCorners) {
  const Seen mirrored = see(config_of("alasca_xt", true), 300);
  const auto found = score_of(mirrored, {});
  EXPECT_EQ(found.true_corners, 2U);  // within the first 125 m
  EXPECT_EQ(found.detected, found.true_corners);
  EXPECT_EQ(found.false_reported, 0U);
}

// The paper's states: every corner of that radius, but driveways and gaps as well.
TEST(Corners, ThePapersReadingsFindThemToo) {
  for (const char* reading : {"fixed", "paper"}) {
    const auto found = score_of(usual_drive(), {{"reading", reading}});
    EXPECT_EQ(found.detected, 4U) << reading;
    EXPECT_GT(found.false_reported, 0U) << reading;
    EXPECT_LT(found.false_reported, found.false_presented) << reading;
  }
}

TEST(Corners, MorePairsOfLinesAreHarderToPlease) {
  std::size_t before = 1000;
  for (const char* pairs : {"1", "2", "3", "4"}) {
    const auto found = score_of(usual_drive(), {{"reading", "fixed"}, {"pairs", pairs}});
    EXPECT_LE(found.reports, before) << pairs;
    before = found.reports;
  }
  EXPECT_GT(score_of(usual_drive(), {{"reading", "fixed"}, {"pairs", "1"}}).detected, 3U);
}

TEST(Corners, WithoutPosesTheStatesTakeOver) {
  Seen seen = usual_drive();
  for (Scan& scan : seen.scans) scan.T_world_sensor.reset();
  const auto combined = detect_on(seen.scans, {});
  const auto fixed = detect_on(seen.scans, {{"reading", "fixed"}});
  ASSERT_EQ(combined.size(), fixed.size());
  std::size_t corners = 0;
  for (std::size_t i = 0; i < combined.size(); ++i) {
    ASSERT_EQ(combined[i].corners.size(), fixed[i].corners.size()) << i;
    corners += combined[i].corners.size();
  }
  EXPECT_GT(corners, 0U);
}

// Two runs, and a standing vehicle between: the same corners.
TEST(Corners, StandingStillChangesNothing) {
  const Seen& seen = usual_drive();
  const std::vector<Scan> first(seen.scans.begin(), seen.scans.begin() + 90);
  std::vector<Scan> stopped = first;
  stopped.insert(stopped.begin() + 60, 200, first[60]);
  const auto went = detect_on(first, {}).back();
  const auto waited = detect_on(stopped, {}).back();
  ASSERT_EQ(went.corners.size(), waited.corners.size());
  EXPECT_FALSE(went.corners.empty());
  for (std::size_t i = 0; i < went.corners.size(); ++i)
    EXPECT_LT(distance(went.corners[i].position, waited.corners[i].position), 0.2);
}

// A LUX half a degree finer, and the rings of an HDL-32E that stand in for four lines.
TEST(Corners, OtherSensorsFindThemAsWell) {
  sim::DriveConfig lux = config_of("lux", false);
  sim::DriveConfig hdl = config_of("hdl32e", false);
  hdl.scenario.stand = {
      .height_m = 1.9, .pitch_deg = 0.0, .roll_deg = 0.0, .forward_deg = 0.0, .ahead_m = 0.8};
  for (const auto& config : {lux, hdl}) {
    const Seen seen = see(config, 200);
    const auto found = score_of(seen, {});
    EXPECT_GE(found.true_corners, 1U);
    EXPECT_EQ(found.detected, found.true_corners) << config.sensor.name;
    EXPECT_EQ(found.false_reported, 0U);
  }
}

}  // namespace verge
