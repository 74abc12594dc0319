// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "verge/core/bytes.hpp"
#include "verge/sensor/velodyne/facts.hpp"

// The data packet (1206 bytes, little-endian; docs/formats_velodyne.md): 12 blocks of 100 bytes (flag u16,
// azimuth u16, 32 x (distance u16, intensity u8)), stamp u32, return mode u8, product u8.
namespace verge::sensor::velodyne {

constexpr std::size_t kDataBytes = 1206;
constexpr std::size_t kPositionBytes = 512;
constexpr std::uint16_t kUpperBank = 0xEEFF;  ///< Block flag, as u16; on the wire FF EE.
constexpr std::uint16_t kLowerBank = 0xDDFF;
constexpr std::uint8_t kModeStrongest = 0x37;
constexpr std::uint8_t kModeLast = 0x38;
constexpr std::uint8_t kModeDual = 0x39;

struct RawBlock {
  std::uint16_t flag = kUpperBank;
  std::uint16_t azimuth = 0;  ///< Hundredths of a degree, clockwise from above, 0..35999.
  std::array<std::uint16_t, kSlotsPerBlock> distance{};  ///< Counts of Facts::range_step_m; 0 = no return.
  std::array<std::uint8_t, kSlotsPerBlock> intensity{};
  bool operator==(const RawBlock&) const = default;
};

/// A data packet, field by field.
struct RawPacket {
  std::array<RawBlock, kBlocksPerPacket> blocks{};
  std::uint32_t stamp_us = 0;  ///< Since the top of the hour.
  std::uint8_t mode = kModeStrongest;
  std::uint8_t product = 0x21;
  bool operator==(const RawPacket&) const = default;
};

using DataBytes = std::array<std::byte, kDataBytes>;

/// Exactly kDataBytes of `payload` field by field, and back; each the other's inverse for every content.
[[nodiscard]] RawPacket parse_packet(Bytes payload);
[[nodiscard]] DataBytes to_bytes(const RawPacket& packet);

/// One block of a packet as the decoder uses it.
struct PlannedBlock {
  std::uint16_t azimuth = 0;
  std::uint8_t bank = 0;
  std::uint8_t step = 0;  ///< Blocks of one step were measured together.
  std::uint8_t echo = 0;  ///< 1: the second of a pair of echoes.
  bool usable = false;
  double turn_per_ns = 0.0;   ///< Hundredths of a degree a nanosecond; laser at t has azimuth + t * this.
  std::int64_t pause_ns = 0;  ///< The step began this much later than its number says (see plan_packet()).
};

/// What a packet's blocks mean, and how fast the head turned while each was measured.
struct PacketPlan {
  std::array<PlannedBlock, kBlocksPerPacket> blocks{};
  std::size_t steps = kBlocksPerPacket;  ///< Steps from this packet's start to the next one's.
  bool dual = false;
  std::size_t rejected_flag = 0;
  std::size_t rejected_azimuth = 0;
};

/// Plans a data packet. The turn of a block is that from it to the next usable step of the packet; where
/// there is none, or it would be slower than 1 or faster than 40 revolutions a second, that of the block
/// before, and of `turn_per_ns` before the first. Blocks with a flag that the model does not have, or an
/// azimuth beyond 35999, are not usable.
[[nodiscard]] PacketPlan plan_packet(Bytes payload, const Facts& facts, double turn_per_ns,
                                     double mean_turn_per_ns = 0.0);

/// Steps from a packet's start to the next one's, as its plan says.
[[nodiscard]] std::size_t steps_of(Bytes payload, const Facts& facts);

/// The model that sent the packet: by its block flags (HDL-64E), else by its product byte; 00 00 is an
/// HDL-32E before firmware 2.2.20.0. None where no model of ours did.
[[nodiscard]] std::optional<Model> model_of(Bytes payload);

/// Whether a packet may come from that model.
[[nodiscard]] bool fits(Bytes payload, const Facts& facts);

}  // namespace verge::sensor::velodyne
