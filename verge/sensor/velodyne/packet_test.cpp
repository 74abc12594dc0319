// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/sensor/velodyne/packet.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "verge/sensor/velodyne/test_packets.hpp"

namespace verge::sensor::velodyne {
namespace {

const Facts& hdl32e() { return facts_of(Model::kHdl32e); }

RawPacket packet_of(std::array<std::uint16_t, kBlocksPerPacket> azimuths) {
  RawPacket packet;
  for (std::size_t b = 0; b < kBlocksPerPacket; ++b) packet.blocks[b].azimuth = azimuths[b];
  return packet;
}

constexpr std::array<std::uint16_t, kBlocksPerPacket> kSteady = {100, 116, 132, 148, 164, 180,
                                                                 196, 212, 228, 244, 260, 276};

RC_GTEST_PROP(VelodynePacket, ParsingAndWritingAreInverse, ()) {
  DataBytes bytes{};
  for (std::byte& b : bytes) b = static_cast<std::byte>(*rc::gen::arbitrary<std::uint8_t>());
  RC_ASSERT(to_bytes(parse_packet(bytes)) == bytes);
}

TEST(VelodynePacket, FieldsStandWhereTheManualHasThem) {
  RawPacket packet = packet_of(kSteady);
  packet.blocks[3].distance[5] = 0x1234;
  packet.blocks[3].intensity[5] = 0x56;
  packet.stamp_us = 0x919CBD7C;  // the manual's example
  const DataBytes bytes = to_bytes(packet);
  EXPECT_EQ(bytes[0], std::byte{0xFF});
  EXPECT_EQ(bytes[1], std::byte{0xEE});
  EXPECT_EQ(bytes[300 + 4 + 15], std::byte{0x34});
  EXPECT_EQ(bytes[300 + 4 + 17], std::byte{0x56});
  EXPECT_EQ(bytes[1200], std::byte{0x7C});
  EXPECT_EQ(bytes[1203], std::byte{0x91});
  EXPECT_EQ(bytes[1204], std::byte{0x37});
  EXPECT_EQ(bytes[1205], std::byte{0x21});
}

TEST(VelodynePacket, TheTurnOfABlockIsThatToTheNext) {
  const PacketPlan plan = plan_packet(to_bytes(packet_of(kSteady)), hdl32e(), 0.0);
  for (const PlannedBlock& block : plan.blocks) EXPECT_DOUBLE_EQ(block.turn_per_ns, 16.0 / 46'080.0);
}

TEST(VelodynePacket, TheTurnGoesAcrossZeroAtEveryBlock) {  // V6
  for (std::size_t wrap = 1; wrap < kBlocksPerPacket; ++wrap) {
    RawPacket packet;
    for (std::size_t b = 0; b < kBlocksPerPacket; ++b) {
      const int azimuth = 35'990 + 20 * (static_cast<int>(b) - static_cast<int>(wrap) + 1);
      packet.blocks[b].azimuth = static_cast<std::uint16_t>(azimuth % kTurn);
    }
    const PacketPlan plan = plan_packet(to_bytes(packet), hdl32e(), 0.0);
    for (const PlannedBlock& block : plan.blocks)
      EXPECT_DOUBLE_EQ(block.turn_per_ns, 20.0 / 46'080.0) << wrap;
  }
}

TEST(VelodynePacket, ABlockWithAnotherFlagIsRejectedAndTheOthersStay) {  // V2
  for (const unsigned flag : {0xFFEEU, 0xDDFFU, 0x0000U, 0xEEFEU}) {
    for (std::size_t at = 0; at < kBlocksPerPacket; ++at) {
      RawPacket packet = packet_of(kSteady);
      packet.blocks[at].flag = static_cast<std::uint16_t>(flag);
      const PacketPlan plan = plan_packet(to_bytes(packet), hdl32e(), 1e-4);
      EXPECT_EQ(plan.rejected_flag, 1U);
      for (std::size_t b = 0; b < kBlocksPerPacket; ++b) {
        EXPECT_EQ(plan.blocks[b].usable, b != at);
        if (b + 1 < at) {
          EXPECT_DOUBLE_EQ(plan.blocks[b].turn_per_ns, 16.0 / 46'080.0);
        }
      }
    }
  }
}

TEST(VelodynePacket, AnAzimuthBeyondTheCircleIsRejectedNotWrapped) {  // V3
  for (const unsigned azimuth : {36'000U, 36'001U, 65'535U}) {
    RawPacket packet = packet_of(kSteady);
    packet.blocks[4].azimuth = static_cast<std::uint16_t>(azimuth);
    const PacketPlan plan = plan_packet(to_bytes(packet), hdl32e(), 0.0);
    EXPECT_EQ(plan.rejected_azimuth, 1U);
    EXPECT_FALSE(plan.blocks[4].usable);
    EXPECT_DOUBLE_EQ(plan.blocks[3].turn_per_ns, 16.0 / 46'080.0) << "over two steps to block 5";
  }
}

TEST(VelodynePacket, AStandingMotorHasTheTurnItHadBefore) {  // V4: no division by zero
  std::array<std::uint16_t, kBlocksPerPacket> standing{};
  standing.fill(777);
  const PacketPlan plan = plan_packet(to_bytes(packet_of(standing)), hdl32e(), 2.5e-4);
  for (const PlannedBlock& block : plan.blocks) EXPECT_DOUBLE_EQ(block.turn_per_ns, 2.5e-4);
}

TEST(VelodynePacket, ALeapThatGoesOnIsAPause) {
  RawPacket packet = packet_of(kSteady);
  for (std::size_t b = 6; b < kBlocksPerPacket; ++b)
    packet.blocks[b].azimuth = static_cast<std::uint16_t>(kSteady[b] + 18'000);
  const PacketPlan plan = plan_packet(to_bytes(packet), hdl32e(), 0.0);
  EXPECT_EQ(plan.blocks[5].pause_ns, 0);
  // 18016 hundredths at 16 a step took 1126 steps, of which the packet counts one.
  EXPECT_EQ(plan.blocks[6].pause_ns, 1125 * 46'080);
  EXPECT_EQ(plan.blocks[11].pause_ns, 1125 * 46'080);
}

TEST(VelodynePacket, ALeapThatComesBackIsNoPause) {  // V5
  for (const int off : {-50, 9000, 20'000}) {
    RawPacket packet = packet_of(kSteady);
    packet.blocks[6].azimuth = static_cast<std::uint16_t>((kSteady[6] + off + kTurn) % kTurn);
    const PacketPlan plan = plan_packet(to_bytes(packet), hdl32e(), 0.0);
    for (const PlannedBlock& block : plan.blocks) EXPECT_EQ(block.pause_ns, 0) << off;
  }
}

TEST(VelodynePacket, DualReturnHasPairsOfBlocks) {
  RawPacket packet;
  packet.mode = kModeDual;
  for (std::size_t b = 0; b < kBlocksPerPacket; ++b) packet.blocks[b].azimuth = kSteady[b / 2];
  const PacketPlan plan = plan_packet(to_bytes(packet), hdl32e(), 0.0);
  EXPECT_TRUE(plan.dual);
  EXPECT_EQ(plan.steps, 6U);
  EXPECT_EQ(plan.blocks[7].step, 3);
  EXPECT_EQ(plan.blocks[7].echo, 1);
  EXPECT_DOUBLE_EQ(plan.blocks[7].turn_per_ns, 16.0 / 46'080.0);
}

TEST(VelodynePacket, TheModelIsFoundByProductByteThenByFlags) {
  RawPacket packet = packet_of(kSteady);
  packet.product = 0x22;
  EXPECT_EQ(model_of(to_bytes(packet)), Model::kVlp16);  // V12
  packet.product = 0x28;
  EXPECT_EQ(model_of(to_bytes(packet)), Model::kVlp32c);
  packet.mode = 0;
  packet.product = 0;
  EXPECT_EQ(model_of(to_bytes(packet)), Model::kHdl32e);  // V11: firmware before 2.2.20.0
  packet.product = 0xA1;
  EXPECT_FALSE(model_of(to_bytes(packet)));
  for (std::size_t b = 1; b < kBlocksPerPacket; b += 2) packet.blocks[b].flag = kLowerBank;
  packet.product = 0x22;  // a status byte that only looks like a product
  EXPECT_EQ(model_of(to_bytes(packet)), Model::kHdl64eS2);
}

}  // namespace
}  // namespace verge::sensor::velodyne
