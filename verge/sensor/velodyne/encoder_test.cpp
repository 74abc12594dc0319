// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/sensor/velodyne/encoder.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>

#include <gtest/gtest.h>

#include "verge/sensor/velodyne/revolutions.hpp"
#include "verge/sensor/velodyne/test_packets.hpp"

namespace verge::sensor::velodyne {
namespace {

constexpr std::int64_t kBeginNs = 1'700'000'000'000'000'000;
constexpr std::int64_t kRevolutionNs = 100'000'000;
constexpr Turning kFromTheRear{.begin_ns = kBeginNs, .begin_azimuth_rad = std::numbers::pi, .rate_hz = 10.0};

std::string name_of(Model model) {
  std::string name(enum_names<Model>[static_cast<std::size_t>(model)]);
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
}

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
                         [](const auto& model) { return name_of(model.param); });

// --- Clouds of which nothing is known but what the decoder handed out.

/// Packets as a sensor sends them, with a motor that trembles, a clock of whole microseconds that drifts, and
/// anything at all measured.
std::vector<testing::Received> random_stream(Model model, bool dual, std::uint32_t seed, double share,
                                             std::size_t count = 60) {
  const Facts& facts = facts_of(model);
  std::uint32_t random = seed;
  const auto next = [&](std::uint32_t below) {
    random = random * 1'664'525U + 1'013'904'223U;
    return (random >> 8U) % below;
  };
  const std::size_t banks = facts.banks_share_step ? 2 : 1;
  const std::size_t blocks_a_step = banks * (dual ? 2 : 1);
  const std::size_t steps = kBlocksPerPacket / blocks_a_step;
  const int turn = static_cast<int>(std::lround(10.0 * kTurn * 1e-9 * facts.step_ns));
  int azimuth = static_cast<int>(next(kTurn));
  std::int64_t time_ns = kBeginNs;
  std::vector<testing::Received> packets;
  for (std::size_t p = 0; p < count; ++p) {
    RawPacket packet;
    packet.mode = dual ? kModeDual : kModeStrongest;
    packet.product = facts.product.value_or(packet.product);
    packet.stamp_us = static_cast<std::uint32_t>(time_ns / 1000 % 3'600'000'000);
    for (std::size_t b = 0; b < kBlocksPerPacket; ++b) {
      RawBlock& block = packet.blocks[b];
      if (b % blocks_a_step == 0) azimuth += turn + static_cast<int>(next(3)) - 1;
      block.azimuth = static_cast<std::uint16_t>(azimuth % kTurn);
      if (banks == 2 && b % 2 == 1) block.flag = kLowerBank;
      if (model == Model::kHdl64eS1 && b % 4 == 0) block.flag = kLowerBank;
      for (std::size_t j = 0; j < kSlotsPerBlock; ++j) {
        if (next(1000) >= share * 1000) continue;
        block.distance[j] = static_cast<std::uint16_t>(1 + next(65'535));
        block.intensity[j] = static_cast<std::uint8_t>(next(256));
        const bool again = dual && b % blocks_a_step >= banks && next(3) == 0;
        if (again) block.distance[j] = packet.blocks[b - banks].distance[j];
      }
    }
    packets.push_back({to_bytes(packet), time_ns});
    time_ns += static_cast<std::int64_t>(steps) * facts.step_ns;
    if (facts.has_clock) time_ns = time_ns / 1000 * 1000 + (next(4) == 0 ? 1000 : 0);
  }
  return packets;
}

/// The packets of what was decoded, revolution by revolution.
std::vector<testing::Received> encoded(Model model, const testing::DecodedStream& decoded,
                                       const std::optional<Calibration>& calibration = std::nullopt) {
  Encoder encoder(model, calibration);
  std::size_t points = 0;
  for (const Revolution& revolution : decoded.revolutions) {
    points += revolution.cloud.x.size();
    if (revolution.stamp_ns) encoder.add(revolution.cloud, *revolution.stamp_ns);
  }
  std::vector<testing::Received> packets;
  for (const SentPacket& packet : encoder.finish()) packets.push_back({packet.bytes, packet.time_ns});
  EXPECT_EQ(encoder.counters().encoded, points);
  EXPECT_EQ(encoder.counters().points, points);
  return packets;
}

/// Where a packet has so few points that several azimuths explain them, they are the same to a bit or two.
void expect_same(const Cloud& a, const Cloud& b, bool exact) {
  ASSERT_EQ(a.intensity, b.intensity);
  ASSERT_EQ(a.echo, b.echo);
  if (exact) {
    ASSERT_TRUE(testing::same_bits(a, b));
  }
  for (std::size_t i = 0; i < a.x.size(); ++i) {
    const float last_bits = 4e-7F * std::hypot(a.x[i], a.y[i]);
    ASSERT_NEAR(a.x[i], b.x[i], last_bits) << i;
    ASSERT_NEAR(a.y[i], b.y[i], last_bits) << i;
    ASSERT_EQ(a.z[i], b.z[i]) << i;
  }
}

void expect_same(const testing::DecodedStream& a, const testing::DecodedStream& b, bool exact) {
  std::vector<const Revolution*> seen_a;
  std::vector<const Revolution*> seen_b;
  for (const Revolution& r : a.revolutions) {
    if (!r.cloud.x.empty()) seen_a.push_back(&r);
  }
  for (const Revolution& r : b.revolutions) {
    if (!r.cloud.x.empty()) seen_b.push_back(&r);
  }
  ASSERT_EQ(seen_a.size(), seen_b.size());
  for (std::size_t i = 0; i < seen_a.size(); ++i) {
    ASSERT_EQ(seen_a[i]->stamp_ns, seen_b[i]->stamp_ns) << i;
    ASSERT_EQ(seen_a[i]->cloud.time_s, seen_b[i]->cloud.time_s) << i;
    ASSERT_EQ(seen_a[i]->cloud.ring, seen_b[i]->cloud.ring) << i;

    expect_same(seen_a[i]->cloud, seen_b[i]->cloud, exact);
  }
}

struct Sensor {
  Model model = Model::kHdl32e;
  bool dual = false;
};

class EncoderInverse : public ::testing::TestWithParam<Sensor> {};

TEST_P(EncoderInverse, DecodedCloudsComeBackBitForBitAndTheirPacketsByteForByte) {
  const auto [model, dual] = GetParam();
  const DecoderConfig config{.model = model};
  // Without a clock, the first return seen is taken for the begin of its packet.
  const double shares[] = {1.0, 0.6, 0.1, facts_of(model).has_clock ? 0.02 : 0.3};
  for (std::uint32_t seed = 1; seed <= 12; ++seed) {
    const double share = shares[seed % 4];
    SCOPED_TRACE(::testing::Message() << "seed " << seed << ", share " << share);
    const auto first = testing::decode(random_stream(model, dual, seed, share), config);
    const auto packets = encoded(model, first);
    const auto second = testing::decode(packets, config);
    expect_same(first, second, share > 0.05);
    const auto again = encoded(model, second);
    ASSERT_EQ(again.size(), packets.size());
    for (std::size_t i = 0; share > 0.05 && i < packets.size(); ++i) {
      ASSERT_EQ(again[i].bytes, packets[i].bytes) << i;
    }
  }
}

TEST_P(EncoderInverse, FullPacketsComeBackByteForByte) {
  const auto [model, dual] = GetParam();
  if (dual) return;  // the stream is one of single returns
  const Facts& facts = facts_of(model);
  const auto packets = testing::stream({.model = model, .packets = 500});
  const auto back = encoded(model, testing::decode(packets, {.model = model}));
  ASSERT_EQ(back.size(), packets.size());
  for (std::size_t i = 0; i < packets.size(); ++i) {
    RawPacket expected = parse_packet(packets[i].bytes);
    RawPacket got = parse_packet(back[i].bytes);
    if (!facts.has_clock) got.stamp_us = expected.stamp_us;  // it says nothing
    ASSERT_EQ(got, expected) << i;
  }
}

TEST_P(EncoderInverse, ItsOwnCalibrationComesBackToo) {
  const auto [model, dual] = GetParam();
  Calibration own = facts_of(model).calibration;
  std::uint32_t random = 3;
  const auto noise = [&](double size) {
    random = random * 1'664'525U + 1'013'904'223U;
    return size * ((random >> 8U) % 2001 / 1000.0 - 1.0);
  };
  for (LaserCorrection& laser : own) {
    laser.elevation_rad += noise(0.0005);
    laser.azimuth_rad += noise(0.05);
    laser.distance_m += noise(0.1);
    laser.up_m += noise(0.05);
    laser.left_m += noise(0.03);
    laser.near = NearCorrection{laser.distance_m + noise(0.03), laser.distance_m + noise(0.03)};
  }
  const DecoderConfig config{.model = model, .calibration = own};
  for (std::uint32_t seed = 1; seed <= 4; ++seed) {
    const auto first = testing::decode(random_stream(model, dual, seed, 0.7, 20), config);
    expect_same(first, testing::decode(encoded(model, first, own), config), true);
  }
}

INSTANTIATE_TEST_SUITE_P(Models, EncoderInverse,
                         ::testing::Values(Sensor{Model::kHdl32e, false}, Sensor{Model::kHdl32e, true},
                                           Sensor{Model::kVlp16, false}, Sensor{Model::kVlp16, true},
                                           Sensor{Model::kVlp32c, false}, Sensor{Model::kVlp32c, true},
                                           Sensor{Model::kHdl64eS1, false}, Sensor{Model::kHdl64eS2, false},
                                           Sensor{Model::kHdl64eS2, true}, Sensor{Model::kHdl64eS3, false},
                                           Sensor{Model::kHdl64eS3, true}),
                         [](const auto& sensor) {
                           return name_of(sensor.param.model) + (sensor.param.dual ? "_dual" : "");
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

TEST(VelodyneEncoder, ACalibrationOfAnotherModelIsRefused) {
  EXPECT_THROW(Encoder(Model::kHdl64eS2, facts_of(Model::kVlp16).calibration), std::invalid_argument);
}

}  // namespace
}  // namespace verge::sensor::velodyne
