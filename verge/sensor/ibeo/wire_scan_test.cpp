// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/sensor/ibeo/wire_scan.hpp"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "verge/sensor/ibeo/ntp.hpp"
#include "verge/sensor/ibeo/test_messages.hpp"

namespace verge::sensor::ibeo {
namespace {

/// Any scan of the sensor: what it sends in each field, in any order.
LuxScan any_lux_scan() {
  LuxScan scan = testing::lux_scan(0);
  scan.start_ntp = testing::kNtp + *rc::gen::inRange<std::uint64_t>(0, 1ULL << 40U);
  scan.end_ntp = scan.start_ntp + *rc::gen::inRange<std::uint64_t>(1U << 20U, 1U << 29U);
  const auto points = *rc::gen::inRange<std::size_t>(1, 400);
  for (std::size_t i = 0; i < points; ++i) {
    scan.points.push_back({.layer = *rc::gen::inRange<std::uint8_t>(0, 4),
                           .echo = *rc::gen::inRange<std::uint8_t>(0, 4),
                           .flags = *rc::gen::arbitrary<std::uint8_t>(),
                           .angle_ticks = *rc::gen::inRange<std::int16_t>(-1600, 1601),
                           .range_cm = *rc::gen::inRange<std::uint16_t>(1, 20'000),
                           .pulse_width_cm = *rc::gen::arbitrary<std::uint16_t>()});
  }
  return scan;
}

bool same_cloud(const Cloud& a, const Cloud& b) {
  bool times = a.time_s.size() == b.time_s.size();
  for (std::size_t i = 0; times && i < a.time_s.size(); ++i) {
    times = std::llround(1e9 * a.time_s[i]) == std::llround(1e9 * b.time_s[i]);
  }
  return times && a.x == b.x && a.y == b.y && a.z == b.z && a.ring == b.ring && a.echo == b.echo &&
         a.pulse_width == b.pulse_width && a.flags == b.flags;
}

}  // namespace

RC_GTEST_PROP(LuxWire, WhatWasDecodedComesBackTimesToTheNanosecond, ()) {
  const MessageCloud decoded = cloud_of(any_lux_scan(), lux());
  const WireLuxScan wire = scan_of(decoded.cloud, decoded.stamp_ns, lux());
  RC_ASSERT(wire.counts.encoded == decoded.cloud.x.size());
  const MessageCloud again = cloud_of(wire.scan, lux());
  RC_ASSERT(same_cloud(again.cloud, decoded.cloud));
  RC_ASSERT(again.stamp_ns == decoded.stamp_ns);
  RC_ASSERT(encode_scan(scan_of(again.cloud, again.stamp_ns, lux()).scan) == encode_scan(wire.scan));
}

RC_GTEST_PROP(AlascaWire, WhatWasDecodedComesBack, ()) {
  AlascaScan scan = testing::alasca_scan(0);
  const auto points = *rc::gen::inRange<std::size_t>(1, 200);
  const AlascaModel model = alasca_xt();
  for (std::size_t i = 0; i < points; ++i) {
    const auto layer = *rc::gen::inRange<std::uint8_t>(0, 4);
    const double x = 0.01 * *rc::gen::inRange(500, 20'000);
    const auto z = code_of_metres(x * std::tan(model.layer_elevation_rad[layer]));
    scan.points.push_back({.layer = layer,
                           .echo = *rc::gen::inRange<std::uint8_t>(0, 4),
                           .status = AlascaStatus{*rc::gen::element<std::uint8_t>(0, 2, 3, 4)},
                           .x_code = *code_of_metres(x),
                           .y_code = 0,
                           .z_code = *z,
                           .pulse_width = *rc::gen::arbitrary<std::uint16_t>()});
  }
  const Cloud decoded = cloud_of(scan, model).cloud;
  const WireAlascaScan wire = scan_of(decoded, model);
  RC_ASSERT(wire.counts.encoded == points);
  RC_ASSERT(same_cloud(cloud_of(wire.scan, model).cloud, decoded));
}

TEST(LuxWire, WhatTheWireCannotSayIsCounted) {
  LuxScan scan = testing::lux_scan(8);
  Cloud cloud = cloud_of(scan, lux()).cloud;
  cloud.x[0] = std::numeric_limits<float>::quiet_NaN();
  cloud.x[1] = cloud.y[1] = cloud.z[1] = 0.0F;
  cloud.z[2] += 1.0F;
  cloud.echo[3] = 4;
  cloud.x[4] = 700.0F;
  cloud.flags[5] = 256;
  cloud.pulse_width[6] = 1000.0F;
  const WireLuxScan wire = scan_of(cloud, std::nullopt, lux());
  EXPECT_EQ(wire.counts, (EncodedPoints{.points = 8, .encoded = 3, .not_on_wire = 5, .altered = 2}));
  EXPECT_EQ(wire.scan.points.size(), 3U);
}

TEST(LuxWire, WithoutAStampTheSensorWasNotToldTheTime) {
  const Cloud cloud = cloud_of(testing::lux_scan(40), lux()).cloud;
  const LuxScan scan = scan_of(cloud, std::nullopt, lux(), 80'000'000).scan;
  EXPECT_FALSE(unix_ns_of(scan.start_ntp));
  EXPECT_NEAR(seconds_between(0, scan.start_ntp), 0.08, 1e-9);
  EXPECT_TRUE(decode_scan(encode_scan(scan)));
}

TEST(LuxWire, ACloudWithoutTimesLastsAsLongAsTheMirrorTakes) {
  Cloud cloud = cloud_of(testing::lux_scan(800), lux()).cloud;
  cloud.time_s.clear();
  const LuxScan scan = scan_of(cloud, 1'700'000'000'000'000'000, lux()).scan;
  const double degrees = (scan.start_angle_ticks - scan.end_angle_ticks) / 32.0;
  EXPECT_NEAR(seconds_between(scan.start_ntp, scan.end_ntp), degrees / 360.0 * 0.08, 1e-8);
}

TEST(LuxWire, AnEmptyCloudIsAScanWithoutPoints) {
  EXPECT_TRUE(decode_scan(encode_scan(scan_of(Cloud{}, std::nullopt, lux()).scan)));
  EXPECT_TRUE(decode_alasca_scan(encode_alasca_scan(scan_of(Cloud{}, alasca_xt()).scan)));
}

TEST(AlascaWire, MissingLayersAreToldByTheElevations) {
  const AlascaModel model = alasca_xt();
  Cloud cloud;
  for (const std::size_t layer : {1U, 3U}) {
    cloud.x.push_back(20.0F);
    cloud.y.push_back(0.0F);
    cloud.z.push_back(static_cast<float>(20.0 * std::tan(model.layer_elevation_rad[layer])));
    cloud.ring.push_back(layer == 1 ? 0 : 1);
  }
  const AlascaScan scan = scan_of(cloud, model).scan;
  ASSERT_EQ(scan.points.size(), 2U);
  EXPECT_EQ(scan.points[0].layer, 1);
  EXPECT_EQ(scan.points[1].layer, 3);
}

}  // namespace verge::sensor::ibeo
