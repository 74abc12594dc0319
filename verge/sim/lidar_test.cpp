// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/sim/lidar.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include "verge/core/angle.hpp"
#include "verge/sensor/hdl32e.hpp"
#include "verge/sim/sensors.hpp"
#include "verge/sim/test_worlds.hpp"

namespace verge::sim {
namespace {

constexpr double kHeight_m = 1.9;
const NoiseConfig kNoNoise{.seed = 1, .range_sigma_m = 0.0, .dropout_at_range_max = 0.0, .reach = 0.0};

// Four walls and a roof around the sensor: every shot comes back.
Caster closed_room() {
  World world;
  add_ground(world, {0.0, 0.0, 0.0}, 30.0, Surface::kRoad);
  add_box(world, {{0.0, 0.0, -1.0}, {40.0, 40.0, 30.0}, 0.3}, Surface::kWall);
  return Caster(std::move(world));
}

Trajectory standing() {
  return [](std::int64_t) { return Pose{{}, {0.0, 0.0, kHeight_m}}; };
}

LidarModel exact(std::string_view name) {
  LidarModel model = sensor_named(name);
  model.range_resolution_m = 0.0;
  return model;
}

TEST(Scan, EachRingOfFlatGroundLiesWithinAMillionthOfHeightOverTangent) {
  for (const SensorEntry& entry : sensors()) {
    LidarModel model = exact(entry.name);
    model.range_max_m = 1e4;
    const Scan scan = simulate_scan(testing::flat_ground(), model, standing(), 0, kNoNoise);
    struct Ring {
      Shot shot;
      std::size_t count = 0;
    };
    std::vector<Ring> rings(model.rings);
    for (const Shot& shot : model.shots(0).shots) rings[shot.ring] = {shot, rings[shot.ring].count + 1};
    for (std::size_t ring = 0; ring < scan.ring_count(); ++ring) {
      const auto& [shot, count] = rings[ring];
      const double along = (kHeight_m + shot.origin.z) / std::tan(-std::asin(shot.direction.z));
      if (!(along > 0.0 && along < 400.0)) continue;  // beyond, the ground ends
      const double expected =
          std::hypot(along, norm(shot.origin.xy()));  // an HDL-64E's begin beside its axis
      const auto [begin, end] = scan.ring(ring);
      ASSERT_EQ(end - begin, count) << entry.name << " ring " << ring;
      for (std::size_t i = begin; i < end; i += 7) {
        ASSERT_NEAR(norm(scan.point(i).xy()), expected, 1e-6 * expected) << entry.name << " ring " << ring;
      }
    }
  }
}

// Paper 1: a four-layer scanner 1 m up, its layers 75 to 78.2 degrees from the vertical straight ahead.
TEST(Scan, PaperOnesLinesLieWherePaperOneSays) {
  const auto pitched = [](std::int64_t) {
    return Pose{from_yaw_pitch_roll(0.0, deg_to_rad(13.4), 0.0), {0.0, 0.0, 1.0}};
  };
  const Scan scan = simulate_scan(testing::flat_ground(), exact("alasca_xt"), pitched, 0, kNoNoise);
  ASSERT_EQ(scan.ring_count(), 4U);
  const std::array<double, 4> printed = {3.732, 4.031, 4.378, 4.787};
  std::array<double, 4> ahead{};
  for (std::size_t ring = 0; ring < 4; ++ring) {
    const auto [begin, end] = scan.ring(ring);
    for (std::size_t i = begin; i < end; ++i) {
      if (std::abs(static_cast<double>(scan.azimuth[i])) > 1e-6) continue;
      ahead[ring] = rotate(pitched(0).rotation, scan.point(i)).x;
    }
    EXPECT_NEAR(ahead[ring], printed[ring], 5e-4);
    EXPECT_NEAR(ahead[ring], std::tan(deg_to_rad(75.0 + 3.2 * static_cast<double>(ring) / 3.0)), 4e-6);
  }
  EXPECT_NEAR(ahead[3] - ahead[0], 1.0547, 5e-5);  // d_l, and d_v of 60 km/h at 20 Hz
  EXPECT_NEAR(60.0 / 3.6 * 1e-9 * static_cast<double>(sensor_named("alasca_xt").period_ns), 0.8333, 5e-5);
}

// Paper 2's table of points: whole degrees for levels 0 and 1, half ones from 34.5 on for levels 2 and 3.
TEST(Scan, ALuxSeesAWallAtTheAzimuthsOfPaperTwo) {
  World wall;
  add_box(wall, {{0.0, 0.0, -50.0}, {60.0, 60.0, 100.0}, 0.0}, Surface::kWall);
  const Scan scan = simulate_scan(Caster(std::move(wall)), exact("lux"), standing(), 0, kNoNoise);
  ASSERT_EQ(scan.ring_count(), 4U);
  for (std::size_t ring = 0; ring < 4; ++ring) {
    std::vector<double> degrees;
    for (std::size_t i = scan.ring(ring).second; i-- > scan.ring(ring).first;) {
      degrees.push_back(0.001 * std::round(1e3 * rad_to_deg(static_cast<double>(scan.azimuth[i]))));
    }
    const std::vector<double> printed = ring < 2
                                            ? std::vector{40.0, 39.0, 38.0, 37.0}
                                            : std::vector{34.5, 33.5, 32.5, 31.5, 30.5, 29.75, 29.25, 28.75};
    const auto first = std::find_if(degrees.begin(), degrees.end(),
                                    [&](double d) { return std::abs(d - printed[0]) < 1e-3; });
    if (ring >= 2) {
      EXPECT_EQ(first, degrees.begin());
    }
    for (std::size_t k = 0; k < printed.size(); ++k) {
      EXPECT_NEAR(*(first + static_cast<std::ptrdiff_t>(k)), printed[k], 1e-3) << "layer " << ring;
    }
  }
}

TEST(Revolution, InAClosedRoomEveryShotOfEveryFiringComesBackOnce) {
  const Scan scan = simulate_scan(closed_room(), exact("hdl32e"), standing(), 0, kNoNoise);
  ASSERT_EQ(scan.ring_count(), 32U);
  EXPECT_EQ(scan.size(), 32U * 2171U);  // 2170.14 firings a revolution: the first holds 2171 starts
  std::vector<std::uint32_t> order = scan.input_index;
  std::sort(order.begin(), order.end());
  for (std::size_t i = 0; i < order.size(); ++i) ASSERT_EQ(order[i], i);
}

TEST(Revolution, SuccessiveRevolutionsFollowEachOtherWithoutGapOrOverlap) {
  const Caster room = closed_room();
  const LidarModel model = exact("hdl32e");
  std::int64_t next_ns = 0;
  for (std::uint64_t index = 0; index < 9; ++index) {
    const Scan scan = simulate_scan(room, model, standing(), index, kNoNoise);
    EXPECT_EQ(scan.stamp_ns, next_ns);
    EXPECT_LT(next_ns - static_cast<std::int64_t>(index) * 100'000'000, 46'080);
    next_ns += scan.motion->duration_ns;
  }
}

TEST(Revolution, TheAzimuthOfAPointIsThatOfTheHeadAtItsTime) {
  const Scan scan = simulate_scan(closed_room(), exact("hdl32e"), standing(), 0, kNoNoise);
  for (std::size_t i = 0; i < scan.size(); i += 7) {
    const double turned = 2.0 * std::numbers::pi * scan.time_offset_ns[i] / 100e6;
    const double expected = std::numbers::pi - turned;  // clockwise from the rear
    const double half_step = deg_to_rad(0.005);         // of the azimuths in a packet
    EXPECT_NEAR(wrap_pi(static_cast<double>(scan.azimuth[i]) - expected), 0.0, half_step + 1e-6);
  }
}

TEST(Revolution, LasersOfOneFiringFollowTheFiringOrder) {
  const Scan scan = simulate_scan(closed_room(), exact("hdl32e"), standing(), 0, kNoNoise);
  const std::vector<sensor::Laser> lasers = sensor::hdl32e().lasers;
  for (std::size_t ring = 0; ring < scan.ring_count(); ++ring) {
    const auto laser =
        std::find_if(lasers.begin(), lasers.end(), [&](const auto& l) { return l.ring == ring; }) -
        lasers.begin();
    const auto [begin, end] = scan.ring(ring);
    for (std::size_t i = begin; i < end; i += 101) {
      EXPECT_EQ(scan.time_offset_ns[i] % 46'080U, 1152U * static_cast<std::uint32_t>(laser));
    }
  }
}

TEST(Revolution, RangesAreMultiplesOfTheSensorsResolution) {
  const NoiseConfig noise{.seed = 4, .range_sigma_m = 0.02, .dropout_at_range_max = 0.0, .reach = 0.0};
  const Scan scan = simulate_scan(closed_room(), sensor_named("hdl32e"), standing(), 0, noise);
  for (std::size_t i = 0; i < scan.size(); ++i) {
    const double counts = norm(scan.point(i)) / 0.002;
    EXPECT_NEAR(counts, std::round(counts), 1e-2);  // x, y, z are single precision
  }
}

// Here and below: within four standard errors, in which 99.994 % of all seeds lie; the seed is fixed.
TEST(Revolution, NoiseHasTheAskedMeanAndDeviation) {
  const Caster room = closed_room();
  const NoiseConfig noise{.seed = 11, .range_sigma_m = 0.02, .dropout_at_range_max = 0.0, .reach = 0.0};
  const Scan clean = simulate_scan(room, exact("hdl32e"), standing(), 0, kNoNoise);
  const Scan noisy = simulate_scan(room, exact("hdl32e"), standing(), 0, noise);
  ASSERT_EQ(clean.size(), noisy.size());
  std::vector<double> range_of_shot(clean.size());
  for (std::size_t i = 0; i < clean.size(); ++i) range_of_shot[clean.input_index[i]] = norm(clean.point(i));
  double sum = 0.0;
  double squares = 0.0;
  for (std::size_t i = 0; i < noisy.size(); ++i) {
    const double error = norm(noisy.point(i)) - range_of_shot[noisy.input_index[i]];
    sum += error;
    squares += error * error;
  }
  const double n = static_cast<double>(clean.size());
  EXPECT_NEAR(sum / n, 0.0, 4.0 * 0.02 / std::sqrt(n));
  EXPECT_NEAR(std::sqrt(squares / n), 0.02, 4.0 * 0.02 / std::sqrt(2.0 * n));
}

TEST(Revolution, TheShareOfLostReturnsGrowsWithTheSquareOfTheRange) {
  const NoiseConfig noise{.seed = 5, .range_sigma_m = 0.0, .dropout_at_range_max = 0.8, .reach = 0.0};
  const LidarModel model = exact("hdl32e");
  const Caster ground = testing::flat_ground();
  const Scan all = simulate_scan(ground, model, standing(), 0, kNoNoise);
  const Scan kept = simulate_scan(ground, model, standing(), 0, noise);
  ASSERT_GE(kept.ring_count(), 23U);
  for (std::size_t ring = 19; ring < 23; ++ring) {
    const double shots = static_cast<double>(all.ring(ring).second - all.ring(ring).first);
    const double returns = static_cast<double>(kept.ring(ring).second - kept.ring(ring).first);
    const double range = norm(all.point(all.ring(ring).first));
    const double share = 0.8 * (range / 100.0) * (range / 100.0);
    EXPECT_NEAR(1.0 - returns / shots, share, 4.0 * std::sqrt(share / shots)) << "range " << range;
  }
}

TEST(Revolution, NothingIsReportedBeyondTheSensorsReach) {
  LidarModel model = exact("hdl32e");
  model.range_min_m = 4.0;
  model.range_max_m = 20.0;
  const Scan scan = simulate_scan(testing::flat_ground(), model, standing(), 0, kNoNoise);
  ASSERT_GT(scan.size(), 1000U);
  for (std::size_t i = 0; i < scan.size(); ++i) {
    EXPECT_GE(norm(scan.point(i)), 4.0 - 1e-5);
    EXPECT_LE(norm(scan.point(i)), 20.0 + 1e-5);
  }
}

TEST(Revolution, EachShotSeesTheWorldFromItsOwnPose) {
  World world;
  add_quad(world, {50, -99, -99}, {50, 99, -99}, {50, 99, 99}, {50, -99, 99}, Surface::kWall);
  const double speed = 60.0 / 3.6;
  const auto driving = [=](std::int64_t ns) {
    return Pose{{}, {speed * 1e-9 * static_cast<double>(ns), 0.0, kHeight_m}};
  };
  const Scan scan = simulate_scan(Caster(std::move(world)), exact("hdl32e"), driving, 3, kNoNoise);
  ASSERT_GT(scan.size(), 1000U);
  const double begin_m = speed * 1e-9 * static_cast<double>(*scan.stamp_ns);
  for (std::size_t i = 0; i < scan.size(); ++i) {
    const double driven_m = begin_m + speed * 1e-9 * scan.time_offset_ns[i];
    EXPECT_NEAR(static_cast<double>(scan.x[i]), 50.0 - driven_m, 1e-5);
  }
}

TEST(Revolution, LabelsSayWhichSurfaceWasHit) {
  const Scan scan = simulate_scan(closed_room(), exact("hdl32e"), standing(), 0, kNoNoise);
  for (std::size_t i = 0; i < scan.size(); ++i) {
    const bool on_floor = std::fabs(static_cast<double>(scan.z[i]) + kHeight_m) < 1e-4;
    const auto floor = static_cast<std::uint32_t>(Surface::kRoad);
    ASSERT_EQ(scan.label[i] == floor, on_floor);
  }
}

auto columns(const Scan& s) {
  return std::tie(s.frame, s.stamp_ns, s.ring_begin, s.x, s.y, s.z, s.azimuth, s.range, s.intensity,
                  s.time_offset_ns, s.label, s.input_index);
}

TEST(Revolution, OneAndManyThreadsGiveTheSameBytes) {
  const Caster room = closed_room();
  const tbb::global_control allow(tbb::global_control::max_allowed_parallelism,
                                  8);  // whatever the machine has
  const auto with_threads = [&](int threads) {
    tbb::task_arena arena(threads);
    return arena.execute(
        [&] { return simulate_scan(room, sensor_named("hdl32e"), standing(), 2, NoiseConfig{}); });
  };
  const Scan one = with_threads(1);
  EXPECT_EQ(columns(one), columns(with_threads(4)));
  EXPECT_EQ(columns(one), columns(with_threads(7)));
}

TEST(Revolution, TheSeedAndTheScanChangeTheNoise) {
  const Caster room = closed_room();
  const LidarModel model = sensor_named("hdl32e");
  const Scan scan = simulate_scan(room, model, standing(), 0, {.seed = 1});
  EXPECT_EQ(scan.x, simulate_scan(room, model, standing(), 0, {.seed = 1}).x);
  EXPECT_NE(scan.x, simulate_scan(room, model, standing(), 0, {.seed = 2}).x);
  EXPECT_NE(scan.x, simulate_scan(room, model, standing(), 1, {.seed = 1}).x);
}

TEST(Revolution, AnEmptyWorldGivesAnEmptyScan) {
  const Scan scan = simulate_scan(Caster(World{}), sensor_named("hdl32e"), standing(), 0, NoiseConfig{});
  EXPECT_EQ(scan.size(), 0U);
  EXPECT_EQ(scan.stamp_ns, 0);
}

TEST(Scan, RefusesASensorNoiseOrWeatherThatCannotBe) {
  const Caster room = closed_room();
  const auto simulate = [&](const NoiseConfig& noise, const Weather& weather) {
    (void)simulate_scan(room, sensor_named("hdl32e"), standing(), 0, noise, weather);
  };
  EXPECT_THROW((void)spinning_lidar({}, {}), std::invalid_argument);
  EXPECT_THROW((void)sensor_named("eye"), std::invalid_argument);
  EXPECT_THROW((void)sensor_named("lux", 10.0), std::invalid_argument);
  EXPECT_THROW((void)sensor_named("vlp16", 30.0), std::invalid_argument);
  EXPECT_THROW(simulate({.range_sigma_m = -0.1}, {}), std::invalid_argument);
  EXPECT_THROW(simulate({.dropout_at_range_max = 1.1}, {}), std::invalid_argument);
  EXPECT_THROW(simulate({}, {.wet_road = 2.0}), std::invalid_argument);
}

}  // namespace
}  // namespace verge::sim
