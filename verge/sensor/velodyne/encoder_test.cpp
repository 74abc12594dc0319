// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/sensor/velodyne/encoder.hpp"

#include <cmath>
#include <numbers>
#include <stdexcept>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "verge/sensor/velodyne/revolutions.hpp"
#include "verge/sensor/velodyne/test_packets.hpp"

namespace verge::sensor::velodyne {
namespace {

constexpr std::int64_t kBeginNs = 1'700'000'000'000'000'000;
constexpr std::int64_t kRevolutionNs = 100'000'000;
constexpr Turning kFromTheRear{.begin_ns = kBeginNs, .begin_azimuth_rad = std::numbers::pi, .rate_hz = 10.0};

/// Returns at ranges and with intensities that differ from shot to shot, in the sensor's own rings and times.
Cloud cloud_of(const Facts& facts, std::uint32_t seed, double share) {
  Cloud cloud;
  const std::vector<std::int64_t> rings = rings_of(facts.calibration);
  std::uint32_t random = seed;
  const auto next = [&] { return (random = random * 1'664'525U + 1'013'904'223U) >> 8U; };
  const auto steps = kRevolutionNs / facts.step_ns;
  for (std::int64_t step = 0; step < steps; ++step) {
    for (std::size_t slot = 0; slot < kSlotsPerBlock; ++slot) {
      if (next() % 1000 >= share * 1000) continue;
      const std::size_t laser = slot % facts.lasers_per_firing;
      const LaserCorrection& aim = facts.calibration[laser];
      const double time_s = 1e-9 * static_cast<double>(step * facts.step_ns + facts.slot_time_ns[slot]);
      const double azimuth = std::numbers::pi + 2.0 * std::numbers::pi * 10.0 * time_s + aim.azimuth_rad;
      const double range = 1.0 + 0.001 * (next() % 90'000);
      cloud.x.push_back(static_cast<float>(range * std::cos(aim.elevation_rad) * std::cos(azimuth)));
      cloud.y.push_back(static_cast<float>(-range * std::cos(aim.elevation_rad) * std::sin(azimuth)));
      cloud.z.push_back(static_cast<float>(range * std::sin(aim.elevation_rad)));
      cloud.intensity.push_back(static_cast<float>(next() % 256));
      cloud.ring.push_back(rings[laser]);
      cloud.time_s.push_back(time_s);
    }
  }
  return cloud;
}

std::vector<SentPacket> encode(Model model, const Cloud& cloud, std::int64_t stamp_ns) {
  Encoder encoder(model);
  encoder.add(cloud, stamp_ns, kFromTheRear, kBeginNs + kRevolutionNs);
  std::vector<SentPacket> packets = encoder.take();
  for (const SentPacket& packet : encoder.finish()) packets.push_back(packet);
  EXPECT_EQ(encoder.counters().points, cloud.x.size());
  EXPECT_EQ(encoder.counters().encoded, cloud.x.size());
  return packets;
}

Revolution decode_first(const std::vector<SentPacket>& packets) {
  std::vector<testing::Received> received;
  for (const SentPacket& packet : packets) received.push_back({packet.bytes, packet.time_ns});
  auto decoded = testing::decode(received);
  return std::move(decoded.revolutions.front());
}

class EncoderRoundTrip : public ::testing::TestWithParam<Model> {};

TEST_P(EncoderRoundTrip, EncodeDecodeEncodeGivesTheSameBytes) {
  const Facts& facts = facts_of(GetParam());
  for (const double share : {1.0, 0.3, 0.01}) {
    const auto packets = encode(GetParam(), cloud_of(facts, 5, share), kBeginNs);
    const Revolution decoded = decode_first(packets);
    const auto again = encode(GetParam(), decoded.cloud, *decoded.stamp_ns);
    ASSERT_EQ(again.size(), packets.size());
    for (std::size_t i = 0; i < packets.size(); ++i) ASSERT_EQ(again[i].bytes, packets[i].bytes) << i;
  }
}

TEST_P(EncoderRoundTrip, PointsComeBackWhereTheyWere) {
  const Facts& facts = facts_of(GetParam());
  const Cloud cloud = cloud_of(facts, 9, 0.7);
  const Revolution decoded = decode_first(encode(GetParam(), cloud, kBeginNs));
  ASSERT_EQ(decoded.cloud.x.size(), cloud.x.size());
  for (std::size_t i = 0; i < cloud.x.size(); ++i) {
    ASSERT_EQ(decoded.cloud.ring[i], cloud.ring[i]);
    ASSERT_EQ(decoded.cloud.intensity[i], cloud.intensity[i]);
    const auto range = [&](const Cloud& c) { return std::hypot(c.x[i], c.y[i], c.z[i]); };
    ASSERT_NEAR(range(decoded.cloud), range(cloud), 0.5 * facts.range_step_m + 5e-5);
    const double turned =
        std::atan2(decoded.cloud.y[i], decoded.cloud.x[i]) - std::atan2(cloud.y[i], cloud.x[i]);
    // Half a hundredth of the block's azimuth, and as much again of the turn to the next one, at most.
    ASSERT_LE(std::abs(std::remainder(turned, 2.0 * std::numbers::pi)), 0.016 * std::numbers::pi / 180.0);
    ASSERT_NEAR(decoded.cloud.time_s[i] + 1e-9 * static_cast<double>(*decoded.stamp_ns - kBeginNs),
                cloud.time_s[i], 1.1e-6);
  }
}

INSTANTIATE_TEST_SUITE_P(Models, EncoderRoundTrip,
                         ::testing::Values(Model::kHdl32e, Model::kVlp16, Model::kVlp32c),
                         [](const auto& model) {
                           return std::string(enum_names<Model>[static_cast<std::size_t>(model.param)]);
                         });

TEST(VelodyneEncoder, PointsThatTheWireCannotSayAreCounted) {
  Cloud cloud = cloud_of(facts_of(Model::kHdl32e), 1, 0.001);
  ASSERT_GE(cloud.x.size(), 5U);
  cloud.x[0] = 1000.0F;
  cloud.y[1] = std::numeric_limits<float>::quiet_NaN();
  cloud.ring[2] = 32;
  cloud.time_s[3] = 7.0;
  cloud.x[4] = cloud.y[4] = cloud.z[4] = 0.0F;
  Encoder encoder(Model::kHdl32e);
  encoder.add(cloud, kBeginNs, kFromTheRear, kBeginNs + kRevolutionNs);
  EXPECT_EQ(encoder.counters().not_on_wire, 5U);
  EXPECT_EQ(encoder.counters().encoded, cloud.x.size() - 5);
}

TEST(VelodyneEncoder, OfTwoPointsOfAShotTheNearerStays) {
  Cloud cloud = cloud_of(facts_of(Model::kHdl32e), 1, 0.001);
  const auto twice = [](auto& column) { column.push_back(column.front()); };
  twice(cloud.ring);
  twice(cloud.time_s);
  twice(cloud.intensity);
  cloud.x.push_back(0.5F * cloud.x.front());
  cloud.y.push_back(0.5F * cloud.y.front());
  cloud.z.push_back(0.5F * cloud.z.front());
  Encoder encoder(Model::kHdl32e);
  encoder.add(cloud, kBeginNs, kFromTheRear, kBeginNs + kRevolutionNs);
  EXPECT_EQ(encoder.counters().displaced, 1U);
  EXPECT_EQ(encoder.counters().encoded, cloud.x.size() - 1);
}

TEST(VelodyneEncoder, SensorsWithTwoBanksAreRefused) {
  EXPECT_THROW(Encoder(Model::kHdl64eS2), std::invalid_argument);
}

}  // namespace
}  // namespace verge::sensor::velodyne
