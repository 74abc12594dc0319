// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/sensor/ibeo/lux.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "verge/core/angle.hpp"
#include "verge/sensor/ibeo/alasca_xt.hpp"
#include "verge/sensor/ibeo/test_messages.hpp"

namespace verge::sensor::ibeo {
namespace {

using ::testing::DoubleNear;
using ::testing::ElementsAre;
using ::testing::FloatNear;
using ::testing::IsEmpty;

/// A scan from +50 to -50 degrees in 20 ms with these points.
LuxScan scan_of(std::vector<LuxPoint> points) {
  LuxScan scan = testing::lux_scan(0);
  scan.points = std::move(points);
  return scan;
}

}  // namespace

TEST(Lux, FactsAreThoseOfTable1OfPaper2) {
  const LuxModel model = lux();
  EXPECT_NEAR(rad_to_deg(model.layer_elevation_rad.back() - model.layer_elevation_rad.front()), 2.4, 1e-12);
  EXPECT_EQ(model.layer_elevation_rad.size(), 4U);
  EXPECT_TRUE(std::is_sorted(model.layer_elevation_rad.begin(), model.layer_elevation_rad.end()));
  const double degrees_per_tick = 360.0 / model.ticks_per_turn;
  EXPECT_DOUBLE_EQ((model.start_angle_ticks - model.end_angle_ticks) * degrees_per_tick, 100.0);
  EXPECT_DOUBLE_EQ(model.range_max_m, 200.0);
  std::map<double, double> step_of;
  for (const ScanRate& rate : model.rates) step_of[rate.rate_hz] = rate.step_ticks * degrees_per_tick;
  EXPECT_EQ(step_of, (std::map<double, double>{{12.5, 0.125}, {25.0, 0.25}, {50.0, 0.5}}));
}

TEST(AlascaXt, FactsAreThoseOfPaper1) {
  const AlascaModel model = alasca_xt();
  ASSERT_EQ(model.layer_elevation_rad.size(), 4U);
  EXPECT_NEAR(rad_to_deg(model.layer_elevation_rad[3] - model.layer_elevation_rad[0]), 3.2, 1e-12);
  for (std::size_t i = 1; i < 4; ++i) {
    EXPECT_NEAR(rad_to_deg(model.layer_elevation_rad[i] - model.layer_elevation_rad[i - 1]), 1.07, 0.005);
  }
  EXPECT_DOUBLE_EQ(model.rate_hz, 20.0);
}

// C5, vector 5.
TEST(LuxCloud, OnePointALayerAt50Metres) {
  std::vector<LuxPoint> points;
  for (std::uint8_t layer = 0; layer < 4; ++layer) points.push_back({.layer = layer, .range_cm = 5000});
  const Cloud cloud = cloud_of(scan_of(points), lux()).cloud;
  EXPECT_THAT(cloud.z, ElementsAre(FloatNear(-1.047F, 5e-4F), FloatNear(-0.349F, 5e-4F),
                                   FloatNear(0.349F, 5e-4F), FloatNear(1.047F, 5e-4F)));
  EXPECT_THAT(cloud.ring, ElementsAre(0, 1, 2, 3));
  EXPECT_THAT(cloud.y, ElementsAre(0.0F, 0.0F, 0.0F, 0.0F));
}

// C5, vector 6.
TEST(LuxCloud, Ticks1600Are50DegreesToTheLeft) {
  const Cloud cloud = cloud_of(scan_of({{.layer = 3,
                                         .echo = 1,
                                         .flags = kClutter,
                                         .angle_ticks = 1600,
                                         .range_cm = 1234,
                                         .pulse_width_cm = 168}}),
                               lux())
                          .cloud;
  EXPECT_NEAR(rad_to_deg(std::atan2(cloud.y[0], cloud.x[0])), 50.0, 1e-5);
  EXPECT_NEAR(std::hypot(cloud.x[0], cloud.y[0], cloud.z[0]), 12.34, 1e-5);
  EXPECT_NEAR(rad_to_deg(std::asin(cloud.z[0] / 12.34F)), 1.2, 1e-5);  // whatever the azimuth: a cone
  EXPECT_THAT(cloud.echo, ElementsAre(1));
  EXPECT_THAT(cloud.flags, ElementsAre(kClutter));
  EXPECT_THAT(cloud.pulse_width, ElementsAre(1.68F));
  EXPECT_THAT(cloud.intensity, IsEmpty());
}

TEST(LuxCloud, TheTurnsTicksAreTheScansOwn) {
  LuxScan scan = scan_of({{.angle_ticks = 90, .range_cm = 100}});
  scan.ticks_per_turn = 360;
  const Cloud cloud = cloud_of(scan, lux()).cloud;
  EXPECT_NEAR(rad_to_deg(std::atan2(cloud.y[0], cloud.x[0])), 90.0, 1e-5);
}

TEST(LuxCloud, TimesRunFromStartToEndWithTheAngle) {
  const MessageCloud made = cloud_of(scan_of({{.angle_ticks = 800, .range_cm = 1},
                                              {.angle_ticks = 0, .range_cm = 1},
                                              {.angle_ticks = -1600, .range_cm = 1},
                                              {.angle_ticks = -2000, .range_cm = 1}}),
                                     lux());
  EXPECT_THAT(made.cloud.time_s,
              ElementsAre(0.0, DoubleNear(0.005, 1e-9), DoubleNear(0.015, 1e-9), DoubleNear(0.015, 1e-9)));
  EXPECT_EQ(made.stamp_ns, 1'348'258'004'005'000'000);
}

TEST(LuxCloud, AScanWithoutAWidthHasAllItsPointsAtOnce) {
  LuxScan scan = scan_of({{.angle_ticks = 5, .range_cm = 1}, {.angle_ticks = -5, .range_cm = 1}});
  scan.end_angle_ticks = scan.start_angle_ticks;
  EXPECT_THAT(cloud_of(scan, lux()).cloud.time_s, ElementsAre(0.0, 0.0));
}

TEST(LuxCloud, ASensorThatWasNotToldTheTimeHasTimesButNoStamp) {
  LuxScan scan = scan_of({{.angle_ticks = 1600, .range_cm = 1}, {.angle_ticks = 0, .range_cm = 1}});
  scan.start_ntp = 1'177'615'933'624;
  scan.end_ntp = 1'177'711'810'024;
  const MessageCloud made = cloud_of(scan, lux());
  EXPECT_EQ(made.stamp_ns, std::nullopt);
  EXPECT_THAT(made.cloud.time_s, ElementsAre(0.0, DoubleNear(0.011162, 1e-6)));
}

// L8, L9.
TEST(LuxCloud, PointsThatCannotBeAreLeftOutAndCounted) {
  std::vector<LuxPoint> points;
  for (std::uint8_t value = 0; value < 16; ++value) {
    points.push_back({.layer = value, .range_cm = 100});
    points.push_back({.echo = value, .range_cm = 100});
    points.push_back({.range_cm = 0});
  }
  const MessageCloud made = cloud_of(scan_of(points), lux());
  EXPECT_EQ(made.counts,
            (PointCounts{
                .received = 48, .used = 8, .no_return = 16, .bad_layer = 12, .bad_echo = 12, .invalid = 0}));
  EXPECT_EQ(made.cloud.x.size(), 8U);
}

TEST(LuxCloud, EightLayersNeedAModelThatHasThem) {
  LuxModel model = lux();
  for (int i = 0; i < 4; ++i) model.layer_elevation_rad.push_back(deg_to_rad(2.0 + 0.8 * i));
  EXPECT_EQ(
      cloud_of(scan_of({{.layer = 7, .range_cm = 100}, {.layer = 8, .range_cm = 100}}), model).counts.used,
      1U);
}

TEST(LuxElevation, ATiltedMirrorLooksDownOnOneSideAndUpOnTheOther) {
  LuxModel model = lux();
  EXPECT_DOUBLE_EQ(elevation_rad(model, 0, 0.3, true), elevation_rad(model, 0, 0.3, false));
  model.beam_tilt_rad = deg_to_rad(0.8);
  // At angle 0 the tilt is -beam_tilt / 2: sqrt(2) sin(-pi / 4) = -1.
  EXPECT_NEAR(rad_to_deg(elevation_rad(model, 1, 0.0, false)), -0.4 - 0.8, 1e-12);
  EXPECT_NEAR(rad_to_deg(elevation_rad(model, 1, 0.0, true)), -0.4 + 0.8, 1e-12);
}

TEST(LuxPulses, PairsTakeTurnsHalfAStepApart) {
  const std::vector<LuxPulse> pulses = pulses_of(lux(), constant_zones(12.5));
  ASSERT_EQ(pulses.size(), 201U + 170U);
  EXPECT_EQ(pulses.front().angle_ticks, 1600);
  EXPECT_EQ(pulses.front().lower_layer, 0);
  for (std::size_t i = 1; i < pulses.size(); ++i) {
    ASSERT_GT(pulses[i - 1].angle_ticks, pulses[i].angle_ticks);
    if (pulses[i - 1].angle_ticks > 1120) continue;
    ASSERT_EQ(pulses[i - 1].angle_ticks - pulses[i].angle_ticks, 8);
    ASSERT_NE(pulses[i - 1].lower_layer, pulses[i].lower_layer);
  }
}

// Paper 2's table: levels 0 and 1 at whole degrees, levels 2 and 3 at half degrees from 34.5 on, and from 30
// degrees on in steps of half a degree, 29.75, 29.25, ...
TEST(LuxPulses, FocusedTheyStandWherePaper2PrintsThem) {
  std::vector<double> lower;
  std::vector<double> upper;
  for (const LuxPulse& pulse : pulses_of(lux(), focused_zones())) {
    (pulse.lower_layer == 0 ? lower : upper).push_back(pulse.angle_ticks / 32.0);
  }
  const auto from = [](const std::vector<double>& all, double first, std::size_t count) {
    const auto begin = std::find(all.begin(), all.end(), first);
    return std::vector<double>(begin, std::min(all.end(), begin + static_cast<std::ptrdiff_t>(count)));
  };
  EXPECT_THAT(from(lower, 50.0, 4), ElementsAre(50.0, 49.0, 48.0, 47.0));
  EXPECT_THAT(from(lower, 40.0, 5), ElementsAre(40.0, 39.0, 38.0, 37.0, 36.0));
  EXPECT_THAT(from(lower, 31.0, 4), ElementsAre(31.0, 30.0, 29.5, 29.0));
  EXPECT_EQ(upper.front(), 34.5);
  EXPECT_THAT(from(upper, 34.5, 8), ElementsAre(34.5, 33.5, 32.5, 31.5, 30.5, 29.75, 29.25, 28.75));
  EXPECT_THAT(from(lower, 10.5, 4), ElementsAre(10.5, 10.0, 9.75, 9.5));
  EXPECT_EQ(lower.back(), -50.0);
}

TEST(AlascaCloud, PointsStandWhereTheirCodesSay) {
  AlascaScan scan = testing::alasca_scan(0);
  scan.points = {{.layer = 2,
                  .echo = 1,
                  .status = AlascaStatus::kRain,
                  .x_code = 10001,
                  .y_code = -250,
                  .z_code = 7,
                  .pulse_width = 12}};
  const MessageCloud made = cloud_of(scan, alasca_xt());
  EXPECT_THAT(made.cloud.x, ElementsAre(100.1F));
  EXPECT_THAT(made.cloud.y, ElementsAre(-2.5F));
  EXPECT_THAT(made.cloud.z, ElementsAre(0.07F));
  EXPECT_THAT(made.cloud.ring, ElementsAre(2));
  EXPECT_THAT(made.cloud.echo, ElementsAre(1));
  EXPECT_THAT(made.cloud.flags, ElementsAre(2U));
  EXPECT_THAT(made.cloud.pulse_width, ElementsAre(12.0F));
  EXPECT_THAT(made.cloud.time_s, IsEmpty());
  EXPECT_EQ(made.stamp_ns, std::nullopt);
}

TEST(AlascaCloud, PointsThatCannotBeAreLeftOutAndCounted) {
  AlascaScan scan = testing::alasca_scan(0);
  scan.points = {{.layer = 4, .x_code = 1},
                 {.echo = 4, .x_code = 1},
                 {.status = AlascaStatus::kInvalid, .x_code = 1},
                 {},
                 {.x_code = 1}};
  const MessageCloud made = cloud_of(scan, alasca_xt());
  EXPECT_EQ(
      made.counts,
      (PointCounts{.received = 5, .used = 1, .no_return = 1, .bad_layer = 1, .bad_echo = 1, .invalid = 1}));
}

}  // namespace verge::sensor::ibeo
