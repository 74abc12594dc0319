// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/sensor/velodyne/revolutions.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "verge/core/angle.hpp"
#include "verge/sensor/velodyne/test_packets.hpp"

namespace verge::sensor::velodyne {
namespace {

using testing::adds_up;
using testing::changed;
using testing::decode;
using testing::DecodedStream;
using testing::Received;
using testing::same_bits;
using testing::stream;
using testing::StreamPlan;

std::vector<Received> with_packet(std::size_t at, const std::function<void(RawPacket&)>& change,
                                  const StreamPlan& plan = {}) {
  std::vector<Received> packets = stream(plan);
  packets[at].bytes = changed(packets[at].bytes, change);
  return packets;
}

void set_all(RawPacket& packet, std::uint16_t distance) {
  for (RawBlock& block : packet.blocks) block.distance.fill(distance);
}

bool same_revolutions(const DecodedStream& a, const DecodedStream& b) {
  return std::equal(a.revolutions.begin(), a.revolutions.end(), b.revolutions.begin(), b.revolutions.end(),
                    [](const Revolution& p, const Revolution& q) {
                      return same_bits(p.cloud, q.cloud) && p.stamp_ns == q.stamp_ns;
                    });
}

// --- What the decoder says of packets that are right.

TEST(VelodyneRevolutions, PointsStandWhereTheFormulasSay) {  // formats C5, vector 1
  RawPacket packet;
  for (std::size_t b = 0; b < kBlocksPerPacket; ++b) {
    packet.blocks[b].azimuth = static_cast<std::uint16_t>(b * 16);
    for (std::size_t j = 0; j < kSlotsPerBlock; ++j) {
      packet.blocks[b].distance[j] = static_cast<std::uint16_t>(1000 + j);
      packet.blocks[b].intensity[j] = static_cast<std::uint8_t>(j);
    }
  }
  const DecodedStream decoded = decode({{to_bytes(packet), 0}});
  ASSERT_EQ(decoded.revolutions.size(), 1U);
  const Cloud& cloud = decoded.revolutions[0].cloud;
  ASSERT_EQ(cloud.x.size(), 384U);
  const Facts& facts = facts_of(Model::kHdl32e);
  for (std::size_t i = 0; i < cloud.x.size(); ++i) {
    const std::size_t b = i / 32;
    const std::size_t j = i % 32;
    const double azimuth =
        deg_to_rad(0.01 * (16.0 * static_cast<double>(b) + 16.0 * 1.152 * static_cast<double>(j) / 46.080));
    const double elevation = facts.calibration[j].elevation_rad;
    const double range = 0.002 * (1000.0 + static_cast<double>(j));
    EXPECT_NEAR(cloud.x[i], range * std::cos(elevation) * std::cos(azimuth), 1e-6);
    EXPECT_NEAR(cloud.y[i], -range * std::cos(elevation) * std::sin(azimuth), 1e-6);
    EXPECT_NEAR(cloud.z[i], range * std::sin(elevation), 1e-6);
    EXPECT_EQ(cloud.ring[i], static_cast<std::int64_t>(j % 2 == 0 ? j / 2 : 16 + j / 2));
    EXPECT_EQ(cloud.intensity[i], static_cast<float>(j));
    EXPECT_NEAR(cloud.time_s[i], 46.080e-6 * static_cast<double>(b) + 1.152e-6 * static_cast<double>(j),
                1e-12);
  }
}

TEST(VelodyneRevolutions, EveryModelGivesWholeRevolutions) {
  for (const Model model :
       {Model::kHdl32e, Model::kVlp16, Model::kVlp32c, Model::kHdl64eS1, Model::kHdl64eS2}) {
    const DecodedStream decoded = decode(stream({.model = model, .packets = 1200}));
    ASSERT_GE(decoded.revolutions.size(), 3U);
    EXPECT_TRUE(adds_up(decoded.counters));
    EXPECT_EQ(decoded.counters.rejected_turn, 0U);
    for (std::size_t k = 0; k + 1 < decoded.revolutions.size(); ++k) {
      const Revolution& revolution = decoded.revolutions[k];
      EXPECT_NEAR(revolution.completeness, 1.0, 2e-3) << k;
      EXPECT_NEAR(static_cast<double>(*decoded.revolutions[k + 1].stamp_ns - *revolution.stamp_ns), 1e8, 3e5);
      const auto rings = std::minmax_element(revolution.cloud.ring.begin(), revolution.cloud.ring.end());
      EXPECT_EQ(*rings.first, 0);
      EXPECT_EQ(*rings.second, static_cast<std::int64_t>(facts_of(model).lasers) - 1);
    }
  }
}

TEST(VelodyneRevolutions, V19AnyRateAndAStepOfIt) {
  for (const double rate_hz : {5.0, 10.0, 20.0}) {
    const DecodedStream decoded = decode(stream({.rate_hz = rate_hz, .packets = 1000}));
    for (std::size_t k = 0; k + 1 < decoded.revolutions.size(); ++k) {
      EXPECT_NEAR(decoded.revolutions[k].completeness, 1.0, 2e-3);
    }
    EXPECT_NEAR(static_cast<double>(decoded.revolutions.size()), 1000 * 552.96e-6 * rate_hz, 1.0);
  }
  std::vector<Received> packets = stream({.packets = 400});
  const RawPacket last = parse_packet(packets.back().bytes);
  for (const Received& packet : stream({.begin_ns = packets.back().time_ns - 600'000 + 552'960,
                                .rate_hz = 20.0,
                                .begin_azimuth = last.blocks[11].azimuth + 16,
                                .packets = 400})) {
    packets.push_back(packet);
  }
  const DecodedStream decoded = decode(packets);
  EXPECT_EQ(decoded.counters.rejected_turn, 0U);
  for (std::size_t k = 0; k + 1 < decoded.revolutions.size(); ++k)
    EXPECT_NEAR(decoded.revolutions[k].completeness, 1.0, 5e-3);
}

TEST(VelodyneRevolutions, TheCutIsASetting) {
  for (const double cut_deg : {0.0, 90.0, 180.0, 359.99, -90.0}) {
    DecoderConfig config;
    config.cut_azimuth_rad = deg_to_rad(cut_deg);
    const DecodedStream decoded = decode(stream({.packets = 800}), config);
    for (std::size_t k = 1; k + 1 < decoded.revolutions.size(); ++k) {
      const Cloud& cloud = decoded.revolutions[k].cloud;
      const double azimuth = std::atan2(-cloud.y[0], cloud.x[0]);
      EXPECT_NEAR(rad_to_deg(wrap_pi(azimuth - deg_to_rad(cut_deg))), 0.0, 0.35) << cut_deg;
    }
  }
}

TEST(VelodyneRevolutions, TheStampMarksTheFirstOrTheLastFiring) {
  DecoderConfig last;
  last.stamp = StampMark::kLast;
  const auto of_first = decode(stream()).revolutions.at(1);
  const auto of_last = decode(stream(), last).revolutions.at(1);
  EXPECT_EQ(*of_first.stamp_ns - *of_last.stamp_ns, 542'592);
  EXPECT_TRUE(same_bits(of_first.cloud, of_last.cloud));
}

TEST(VelodyneRevolutions, ACalibrationTakesThePlaceOfTheModels) {
  DecoderConfig config;
  config.model = Model::kHdl32e;
  config.calibration = facts_of(Model::kHdl32e).calibration;
  for (LaserCorrection& laser : *config.calibration) laser.distance_m = 0.5;
  const Cloud plain = decode(stream()).revolutions.at(0).cloud;
  const Cloud corrected = decode(stream(), config).revolutions.at(0).cloud;
  ASSERT_EQ(plain.x.size(), corrected.x.size());
  for (std::size_t i = 0; i < plain.x.size(); i += 97) {
    EXPECT_NEAR(std::hypot(corrected.x[i], corrected.y[i], corrected.z[i]) -
                    std::hypot(plain.x[i], plain.y[i], plain.z[i]),
                0.5, 1e-4);
  }
  config.calibration->pop_back();
  EXPECT_THROW(RevolutionDecoder{config}, std::invalid_argument);
}

TEST(VelodyneRevolutions, OffsetsAndNearCorrectionsOfAnHdl64e) {
  Calibration calibration = facts_of(Model::kHdl64eS2).calibration;
  for (LaserCorrection& laser : calibration) {
    laser.azimuth_rad = 0.0;
    laser.distance_m = 1.0;
    laser.near = NearCorrection{1.2, 1.4};
  }
  DecoderConfig config;
  config.model = Model::kHdl64eS2;
  config.calibration = calibration;
  RawPacket packet = parse_packet(stream({.model = Model::kHdl64eS2, .packets = 1})[0].bytes);
  set_all(packet, 5000);                                    // 10 m
  for (RawBlock& block : packet.blocks) block.azimuth = 0;  // straight ahead, standing
  const Cloud cloud = decode({{to_bytes(packet), 0}}, config).revolutions.at(0).cloud;
  const Facts& facts = facts_of(Model::kHdl64eS2);
  for (std::size_t slot = 0; slot < kSlotsPerBlock; ++slot) {
    const LaserCorrection& laser = calibration[slot];
    const double level = std::cos(laser.elevation_rad);
    const double along = (11.0 * level - 1.93) / (25.04 - 1.93);
    const double ahead = 10.0 + 1.4 + along * (1.0 - 1.4);
    EXPECT_NEAR(cloud.x[slot], ahead * level, 1e-4);
    EXPECT_NEAR(cloud.y[slot], laser.left_m, 1e-4);
    EXPECT_EQ(cloud.ring[slot], rings_of(facts.calibration)[slot]);
  }
}

// --- V: what is wrong with packets.

TEST(VelodyneRevolutions, V1OtherSizesAreCounted) {
  RevolutionDecoder decoder;
  std::vector<std::byte> bytes(65'507);
  for (const std::size_t size : {0U, 1U, 511U, 513U, 1205U, 1207U, 65'507U})
    decoder.add(Bytes(bytes).first(size), 0);
  EXPECT_EQ(decoder.counters().rejected_size, 7U);
  EXPECT_FALSE(decoder.finish());
}

TEST(VelodyneRevolutions, V2V3ABadBlockCostsItsPointsAlone) {
  const DecodedStream good = decode(stream());
  for (std::size_t at = 0; at < kBlocksPerPacket; ++at) {
    const DecodedStream flag = decode(with_packet(20, [&](RawPacket& p) { p.blocks[at].flag = 0xFFEE; }));
    EXPECT_EQ(flag.counters.rejected_flag, 1U);
    EXPECT_EQ(flag.counters.points.used, good.counters.points.used - 32);
    EXPECT_TRUE(adds_up(flag.counters));
    const DecodedStream azimuth =
        decode(with_packet(20, [&](RawPacket& p) { p.blocks[at].azimuth = 36'000; }));
    EXPECT_EQ(azimuth.counters.rejected_azimuth, 1U);
    EXPECT_EQ(azimuth.counters.points.used, good.counters.points.used - 32);
  }
}

TEST(VelodyneRevolutions, V4AStandingMotorEndsRevolutionsByTime) {
  std::vector<Received> packets = stream({.packets = 5000});
  for (Received& packet : packets) {
    packet.bytes = changed(packet.bytes, [](RawPacket& p) {
      for (RawBlock& block : p.blocks) block.azimuth = 4321;
    });
  }
  const DecodedStream decoded = decode(packets);
  ASSERT_EQ(decoded.revolutions.size(), 3U);  // 2.76 s
  EXPECT_TRUE(decoded.revolutions[0].stalled);
  EXPECT_TRUE(adds_up(decoded.counters));
  EXPECT_EQ(decoded.counters.points.used, 5000U * 384);
}

TEST(VelodyneRevolutions, V5AnAzimuthThatGoesBackIsNotFollowed) {
  for (const int off : {-100, -9000, 9000, 18'000}) {
    const DecodedStream decoded = decode(with_packet(100, [&](RawPacket& p) {
      p.blocks[5].azimuth = static_cast<std::uint16_t>((p.blocks[5].azimuth + off + kTurn) % kTurn);
    }));
    EXPECT_EQ(decoded.counters.rejected_turn, 1U) << off;
    EXPECT_EQ(decoded.revolutions.size(), decode(stream()).revolutions.size());
    EXPECT_TRUE(adds_up(decoded.counters));
  }
}

TEST(VelodyneRevolutions, V6TheCutIsFoundAtEveryBlock) {
  for (int at = 0; at < 12; ++at) {
    const DecodedStream decoded = decode(stream({.begin_azimuth = 18'000 - 17 * at, .packets = 500}));
    const std::size_t whole = at == 0 ? 0 : 1;
    ASSERT_GE(decoded.revolutions.size(), whole + 2);
    EXPECT_NEAR(static_cast<double>(decoded.revolutions[whole].cloud.x.size()), 69'444.0, 64.0) << at;
  }
}

TEST(VelodyneRevolutions, V7NoReturnsAtAllIsACompleteRevolutionWithoutPoints) {
  std::vector<Received> packets = stream();
  for (Received& packet : packets) packet.bytes = changed(packet.bytes, [](RawPacket& p) { set_all(p, 0); });
  const DecodedStream decoded = decode(packets);
  EXPECT_NEAR(decoded.revolutions.at(0).completeness, 1.0, 2e-3);
  EXPECT_TRUE(decoded.revolutions.at(0).cloud.x.empty());
  EXPECT_FALSE(decoded.revolutions.at(0).stamp_ns);
  EXPECT_EQ(decoded.counters.points.no_return, decoded.counters.points.measured);
}

TEST(VelodyneRevolutions, V8V9RangesBeyondTheReachAreCounted) {
  const auto all = [](std::uint16_t distance) {
    return decode({{to_bytes([&] {
                      RawPacket packet = parse_packet(stream({.packets = 1})[0].bytes);
                      set_all(packet, distance);
                      return packet;
                    }()),
                    0}})
        .counters.points;
  };
  EXPECT_EQ(all(65'535).above_max, 384U);
  EXPECT_EQ(all(50'001).above_max, 384U);
  EXPECT_EQ(all(50'000).used, 384U) << "100 m";
  EXPECT_EQ(all(450).used, 384U) << "0.9 m";
  EXPECT_EQ(all(449).below_min, 384U);
  EXPECT_EQ(all(1).below_min, 384U);
}

TEST(VelodyneRevolutions, V10StampsAtTheHoursEnds) {
  for (const std::uint32_t stamp : {0U, 3'599'999'999U, 3'600'000'000U, 3'600'060'000U, 0xFFFFFFFFU}) {
    const DecodedStream decoded = decode(with_packet(150, [&](RawPacket& p) { p.stamp_us = stamp; }));
    EXPECT_EQ(decoded.counters.stamps_estimated, 1U) << stamp;  // the stream is in the middle of an hour
    EXPECT_EQ(decoded.counters.points.used, 400U * 384);
    EXPECT_EQ(decoded.revolutions.size(), decode(stream()).revolutions.size());
  }
}

TEST(VelodyneRevolutions, V10TheHourWrapsWithoutAStep) {
  const DecodedStream decoded =
      decode(stream({.begin_ns = 472'222LL * 3'600'000'000'000 - 150'000'000, .packets = 800}));
  EXPECT_EQ(decoded.counters.stamps_estimated + decoded.counters.clock_jumps, 0U);
  for (std::size_t k = 0; k + 2 < decoded.revolutions.size(); ++k) {
    EXPECT_NEAR(static_cast<double>(*decoded.revolutions[k + 1].stamp_ns - *decoded.revolutions[k].stamp_ns),
                1e8, 1e5);
  }
}

TEST(VelodyneRevolutions, V10StampsThatRunBeyondTheHourBeforeTheyWrap) {  // ros-drivers/velodyne#218
  std::vector<Received> packets =
      stream({.begin_ns = 472'222LL * 3'600'000'000'000 - 150'000'000, .packets = 800});
  const DecodedStream right = decode(packets);
  for (Received& packet : packets) {
    packet.bytes = changed(packet.bytes, [](RawPacket& p) {
      if (p.stamp_us < 60'000) p.stamp_us += 3'600'000'000U;
    });
  }
  EXPECT_TRUE(same_revolutions(decode(packets), right));
}

TEST(VelodyneRevolutions, V11FactoryBytesOfZeroAreAnHdl32e) {
  std::vector<Received> packets = stream();
  for (Received& packet : packets) {
    packet.bytes = changed(packet.bytes, [](RawPacket& p) { p.mode = p.product = 0; });
  }
  EXPECT_TRUE(same_revolutions(decode(packets), decode(stream())));
}

TEST(VelodyneRevolutions, V12AnotherModelThanTheOneToldIsRejected) {
  DecoderConfig config;
  config.model = Model::kHdl32e;
  const DecodedStream decoded = decode(stream({.model = Model::kVlp16}), config);
  EXPECT_EQ(decoded.counters.rejected_model, 400U);
  EXPECT_TRUE(decoded.revolutions.empty());
  EXPECT_TRUE(adds_up(decoded.counters));
}

RawPacket dual_packet(std::uint16_t last, std::uint16_t strongest) {
  RawPacket packet = parse_packet(stream({.packets = 1})[0].bytes);
  packet.mode = kModeDual;
  for (std::size_t b = 0; b < kBlocksPerPacket; ++b) {
    packet.blocks[b].azimuth = static_cast<std::uint16_t>(18'000 + 16 * (b / 2));
    packet.blocks[b].distance.fill(b % 2 == 0 ? last : strongest);
  }
  return packet;
}

TEST(VelodyneRevolutions, TwoEchoesAreNumberedByDistance) {
  const Cloud cloud = decode({{to_bytes(dual_packet(5000, 4000)), 0}}).revolutions.at(0).cloud;
  ASSERT_EQ(cloud.echo.size(), 384U);
  for (std::size_t i = 0; i < 384; ++i) {
    EXPECT_EQ(cloud.echo[i], std::hypot(cloud.x[i], cloud.y[i], cloud.z[i]) > 9.0F ? 1 : 0);
  }
}

TEST(VelodyneRevolutions, EqualEchoesAreOneAndAMissingOneIsNone) {
  const DecodedStream same = decode({{to_bytes(dual_packet(5000, 5000)), 0}});
  EXPECT_EQ(same.counters.points.used, 192U);
  EXPECT_EQ(same.counters.points.same_echo, 192U);
  EXPECT_TRUE(adds_up(same.counters));
  const DecodedStream one = decode({{to_bytes(dual_packet(5000, 0)), 0}});
  EXPECT_EQ(one.counters.points.used, 192U);
  EXPECT_EQ(one.counters.points.no_return, 192U);
}

TEST(VelodyneRevolutions, V13HalfAPairIsASingleReturn) {
  RawPacket packet = dual_packet(5000, 4000);
  packet.blocks[3].flag = 0;
  const DecodedStream decoded = decode({{to_bytes(packet), 0}});
  EXPECT_EQ(decoded.counters.points.used, 11U * 32);
  EXPECT_TRUE(adds_up(decoded.counters));
}

TEST(VelodyneRevolutions, V14TheModeMaySwitchInMidStream) {
  std::vector<Received> packets = stream({.packets = 40});
  for (std::size_t i = 20; i < 40; ++i) {
    packets[i].bytes = changed(packets[i].bytes, [](RawPacket& p) {
      p.mode = kModeDual;
      for (std::size_t b = 1; b < kBlocksPerPacket; b += 2) p.blocks[b].azimuth = p.blocks[b - 1].azimuth;
    });
  }
  const DecodedStream decoded = decode(packets);
  EXPECT_TRUE(adds_up(decoded.counters));
  for (const Revolution& revolution : decoded.revolutions) {
    EXPECT_EQ(revolution.cloud.echo.size(), revolution.cloud.x.size());
  }
}

RC_GTEST_PROP(VelodyneRevolutions, V15DuplicatesChangeNothing, ()) {  // B5 3
  const std::vector<Received> packets = stream({.packets = 50});
  std::vector<Received> doubled;
  std::uint64_t duplicates = 0;
  for (std::size_t i = 0; i < packets.size(); ++i) {
    doubled.push_back(packets[i]);
    if (*rc::gen::inRange(0, 10) == 0) {
      doubled.push_back(packets[i - std::min<std::size_t>(i, *rc::gen::inRange<std::size_t>(0, 12))]);
      ++duplicates;
    }
  }
  const DecodedStream decoded = decode(doubled);
  RC_ASSERT(decoded.counters.duplicates == duplicates);
  RC_ASSERT(same_revolutions(decoded, decode(packets)));
}

TEST(VelodyneRevolutions, V16APacketOfTheRevolutionBeforeIsLate) {
  std::vector<Received> packets = stream();
  const Received old = packets[30];
  packets.erase(packets.begin() + 30);
  const DecodedStream right = decode(packets);
  packets.insert(packets.begin() + 230, old);
  const DecodedStream decoded = decode(packets);
  EXPECT_EQ(decoded.counters.late, 1U);
  EXPECT_TRUE(same_revolutions(decoded, right));
}

RC_GTEST_PROP(VelodyneRevolutions, V17SwappedPacketsArePutInOrder, ()) {
  std::vector<Received> packets = stream({.packets = 60});
  const DecodedStream right = decode(packets);
  for (std::size_t i = 0; i + 16 < packets.size(); i += 17) {
    std::swap(packets[i], packets[i + *rc::gen::inRange<std::size_t>(0, 16)]);
  }
  RC_ASSERT(same_revolutions(decode(packets), right));
}

RC_GTEST_PROP(VelodyneRevolutions, V18FlippedBytesKeepTheCountersAndThePointsSound, ()) {
  std::vector<Received> packets = stream({.packets = 40});
  for (int flip = 0; flip < 20; ++flip) {
    Received& packet = packets[*rc::gen::inRange<std::size_t>(0, packets.size())];
    packet.bytes[*rc::gen::inRange<std::size_t>(0, kDataBytes)] ^=
        static_cast<std::byte>(*rc::gen::inRange(1, 256));
  }
  const DecodedStream decoded = decode(packets);
  RC_ASSERT(adds_up(decoded.counters));
  for (const Revolution& revolution : decoded.revolutions) {
    for (std::size_t i = 0; i < revolution.cloud.x.size(); ++i) {
      const float range = std::hypot(revolution.cloud.x[i], revolution.cloud.y[i], revolution.cloud.z[i]);
      RC_ASSERT(range >= 0.899F && range <= 100.001F);
    }
  }
}

// --- Laws (reliability B5).

RC_GTEST_PROP(VelodyneRevolutions, LawTurningTheAzimuthsTurnsTheCloud, ()) {  // B5 1
  const int turn = *rc::gen::inRange(0, 36'000);
  const std::vector<Received> packets = stream({.packets = 30, .distance = 49'000});
  std::vector<Received> turned = packets;
  for (Received& packet : turned) {
    packet.bytes = changed(packet.bytes, [&](RawPacket& p) {
      for (RawBlock& b : p.blocks) b.azimuth = static_cast<std::uint16_t>((b.azimuth + turn) % kTurn);
    });
  }
  DecoderConfig config;
  config.cut_azimuth_rad = std::numbers::pi + deg_to_rad(0.01 * turn);
  const Cloud a = decode(packets).revolutions.at(0).cloud;
  const Cloud b = decode(turned, config).revolutions.at(0).cloud;
  RC_ASSERT(a.x.size() == b.x.size());
  const double c = std::cos(deg_to_rad(0.01 * turn));
  const double s = std::sin(deg_to_rad(0.01 * turn));
  for (std::size_t i = 0; i < a.x.size(); i += 31) {
    RC_ASSERT(std::abs(double{a.x[i]} * c + double{a.y[i]} * s - double{b.x[i]}) <= 1e-4);
    RC_ASSERT(std::abs(double{a.y[i]} * c - double{a.x[i]} * s - double{b.y[i]}) <= 1e-4);
    RC_ASSERT(a.z[i] == b.z[i]);
  }
}

RC_GTEST_PROP(VelodyneRevolutions, LawALostPacketChangesItsOwnRevolutionAlone, ()) {  // B5 4
  std::vector<Received> packets = stream({.rate_hz = 39.0, .packets = 120});
  const DecodedStream right = decode(packets);
  const auto at = *rc::gen::inRange<std::size_t>(50, 85);  // of the second revolution
  packets.erase(packets.begin() + static_cast<std::ptrdiff_t>(at));
  const DecodedStream lost = decode(packets);
  RC_ASSERT(lost.revolutions.size() == right.revolutions.size());
  for (std::size_t k = 0; k < right.revolutions.size(); ++k) {
    RC_ASSERT(same_bits(lost.revolutions[k].cloud, right.revolutions[k].cloud) == (k != 1));
  }
  RC_ASSERT(std::abs(lost.revolutions[1].completeness - (1.0 - 39.0 / 1808.45)) < 0.003);
}

TEST(VelodyneRevolutions, LawAGapOfSeveralTurnsEndsOneRevolution) {
  std::vector<Received> packets = stream({.packets = 1500});
  packets.erase(packets.begin() + 270, packets.begin() + 270 + 543);  // three turns and a little
  const DecodedStream decoded = decode(packets);
  EXPECT_EQ(decoded.counters.rejected_turn, 0U);
  EXPECT_NEAR(decoded.revolutions.at(1).completeness, 0.493, 0.01);
  EXPECT_NEAR(decoded.revolutions.at(2).completeness, 0.507, 0.01);
}

RC_GTEST_PROP(VelodyneRevolutions, LawOtherPacketsBetweenChangeNoPoint, ()) {  // B5 5
  const std::vector<Received> packets = stream({.packets = 40});
  RevolutionDecoder decoder;
  std::vector<std::byte> foreign(*rc::gen::inRange<std::size_t>(0, 1500), std::byte{0x24});
  if (foreign.size() == kDataBytes) foreign.pop_back();
  DecodedStream mixed;
  for (const Received& packet : packets) {
    if (*rc::gen::inRange(0, 4) == 0) decoder.add(foreign, packet.time_ns);
    decoder.add(packet.bytes, packet.time_ns);
    while (auto revolution = decoder.take()) mixed.revolutions.push_back(*std::move(revolution));
  }
  while (auto revolution = decoder.finish()) mixed.revolutions.push_back(*std::move(revolution));
  RC_ASSERT(same_revolutions(mixed, decode(packets)));
}

TEST(VelodyneRevolutions, LawNoRevolutionIsMoreThanATurnAndAFiring) {  // B5 7
  for (const double rate_hz : {4.7, 9.3, 19.9}) {
    const DecodedStream decoded = decode(stream({.rate_hz = rate_hz, .packets = 1200}));
    for (const Revolution& revolution : decoded.revolutions) {
      const double seconds = revolution.cloud.time_s.back() - revolution.cloud.time_s.front();
      EXPECT_LE(seconds, 1.0 / rate_hz + 46.08e-6 + 2e-6);
    }
  }
}

TEST(VelodyneRevolutions, LawPointsAreFiniteAndKeepTheirRange) {  // B5 8
  const std::vector<Received> packets = stream({.packets = 200, .distance = 450});
  for (const Revolution& revolution : decode(packets).revolutions) {
    for (std::size_t i = 0; i < revolution.cloud.x.size(); ++i) {
      const double range = std::hypot(revolution.cloud.x[i], revolution.cloud.y[i], revolution.cloud.z[i]);
      ASSERT_LE(std::abs(range / 0.002 - std::round(range / 0.002)), 0.05);
    }
  }
}

TEST(VelodyneRevolutions, ASensorThatSendsASectorGivesOneRevolutionATurn) {
  std::vector<Received> packets;
  // Blocks of the front half only, packed without a gap, as the sensor does it; stamps of the first block.
  const std::vector<Received> full = stream({.packets = 1000});
  RawPacket packet;
  std::size_t filled = 0;
  std::int64_t first_ns = 0;
  for (const Received& from : full) {
    const RawPacket source = parse_packet(from.bytes);
    for (std::size_t b = 0; b < kBlocksPerPacket; ++b) {
      const int azimuth = source.blocks[b].azimuth;
      if (azimuth > 9000 && azimuth < 27'000) continue;
      if (filled == 0) first_ns = from.time_ns - 600'000 + static_cast<std::int64_t>(b) * 46'080;
      packet.blocks[filled++] = source.blocks[b];
      if (filled < kBlocksPerPacket) continue;
      packet.stamp_us = static_cast<std::uint32_t>(first_ns % 3'600'000'000'000 / 1000);
      packets.push_back({to_bytes(packet), first_ns});
      filled = 0;
    }
  }
  const DecodedStream decoded = decode(packets);
  EXPECT_LE(decoded.counters.rejected_turn, 6U) << "a block at a packet's end cannot be told from a fault";
  ASSERT_EQ(decoded.revolutions.size(), 6U);
  for (std::size_t k = 0; k + 1 < decoded.revolutions.size(); ++k)
    EXPECT_NEAR(decoded.revolutions[k].completeness, 0.5, 0.01);
}

TEST(VelodyneRevolutions, TheSameBytesGiveTheSameRevolutions) {
  EXPECT_TRUE(same_revolutions(decode(stream()), decode(stream())));
}

TEST(VelodyneRevolutions, SettingsThatAreNotFiniteAreRefused) {
  DecoderConfig config;
  config.cut_azimuth_rad = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(RevolutionDecoder{config}, std::invalid_argument);
}

}  // namespace
}  // namespace verge::sensor::velodyne
