// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/sensor/velodyne/test_packets.hpp"

#include <cmath>
#include <utility>

namespace verge::sensor::velodyne::testing {
namespace {

constexpr std::int64_t kHourNs = 3'600'000'000'000;

RawPacket packet_at(const StreamPlan& plan, const Facts& facts, std::size_t number) {
  RawPacket packet;
  const std::size_t shared = facts.banks_share_step ? 2 : 1;
  const std::size_t steps = kBlocksPerPacket / shared;
  const double step_turn = plan.rate_hz * kTurn * 1e-9 * facts.step_ns;
  for (std::size_t b = 0; b < kBlocksPerPacket; ++b) {
    RawBlock& block = packet.blocks[b];
    const auto step = static_cast<double>(number * steps + b / shared);
    block.flag = shared == 2 && b % 2 == 1 ? kLowerBank : kUpperBank;
    if (facts.model == Model::kHdl64eS1 && b % 4 == 0) block.flag = kLowerBank;
    block.azimuth = static_cast<std::uint16_t>(std::llround(plan.begin_azimuth + step * step_turn) % kTurn);
    for (std::size_t j = 0; j < kSlotsPerBlock; ++j) {
      block.distance[j] = static_cast<std::uint16_t>(plan.distance + (number + 7 * b + 13 * j) % 1000);
      block.intensity[j] = static_cast<std::uint8_t>(j);
    }
  }
  const std::int64_t time_ns = plan.begin_ns + static_cast<std::int64_t>(number * steps) * facts.step_ns;
  packet.stamp_us = static_cast<std::uint32_t>(time_ns % kHourNs / 1000);
  if (facts.product) packet.product = *facts.product;
  return packet;
}

}  // namespace

std::vector<Received> stream(const StreamPlan& plan) {
  const Facts& facts = facts_of(plan.model);
  const std::size_t steps = kBlocksPerPacket / (facts.banks_share_step ? 2 : 1);
  std::vector<Received> packets;
  for (std::size_t number = 0; number < plan.packets; ++number) {
    const std::int64_t time_ns = plan.begin_ns + static_cast<std::int64_t>(number * steps) * facts.step_ns;
    packets.push_back({to_bytes(packet_at(plan, facts, number)), time_ns + 600'000});
  }
  return packets;
}

DataBytes changed(const DataBytes& bytes, const std::function<void(RawPacket&)>& change) {
  RawPacket packet = parse_packet(bytes);
  change(packet);
  return to_bytes(packet);
}

DecodedStream decode(const std::vector<Received>& packets, const DecoderConfig& config) {
  RevolutionDecoder decoder(config);
  DecodedStream out;
  for (const Received& packet : packets) {
    decoder.add(packet.bytes, packet.time_ns);
    while (auto revolution = decoder.take()) out.revolutions.push_back(*std::move(revolution));
  }
  while (auto revolution = decoder.finish()) out.revolutions.push_back(*std::move(revolution));
  out.counters = decoder.counters();
  return out;
}

bool adds_up(const Counters& c) {
  const PointCounters& p = c.points;
  return c.packets == c.data + c.positions + c.rejected_size + c.rejected_model + c.duplicates + c.late &&
         c.blocks == kBlocksPerPacket * c.data &&
         c.blocks == c.blocks_used + c.rejected_flag + c.rejected_azimuth + c.rejected_turn &&
         c.positions == c.nmea_used + c.nmea_unlocked + c.nmea_absent + c.nmea_ignored + c.nmea_rolled_over &&
         c.stamps == c.data + c.late && c.stamps_estimated <= c.stamps &&
         p.measured == kSlotsPerBlock * c.blocks_used &&
         p.measured == p.used + p.no_return + p.below_min + p.above_max + p.same_echo;
}

bool same_bits(const Cloud& a, const Cloud& b) {
  return a.x == b.x && a.y == b.y && a.z == b.z && a.intensity == b.intensity && a.ring == b.ring &&
         a.time_s == b.time_s && a.echo == b.echo;
}

}  // namespace verge::sensor::velodyne::testing
