// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "tests/fuzz/fuzz.hpp"
#include "verge/sensor/velodyne/test_packets.hpp"

namespace verge::fuzz {
namespace {

namespace velodyne = sensor::velodyne;
namespace packets = velodyne::testing;

constexpr std::size_t kCommandBytes = 4;
// The fewest packets that show a whole revolution between its two cuts, at about the fastest a head may turn.
constexpr std::size_t kPackets = 64;
constexpr packets::StreamPlan kPlan{.rate_hz = 39.0, .begin_azimuth = 17'000, .packets = kPackets};

/// A drive of few points: of each packet three blocks are there, the others have lost their flags. What is
/// made of a whole packet is the business of hdl_packet; here it is what packets do to each other.
std::vector<packets::Received> sparse_drive() {
  std::vector<packets::Received> drive = packets::stream(kPlan);
  for (packets::Received& packet : drive) {
    packet.bytes = packets::changed(packet.bytes, [](velodyne::RawPacket& raw) {
      for (std::size_t b = 0; b < velodyne::kBlocksPerPacket; ++b) {
        if (b % 4 != 0) raw.blocks[b].flag = 0;
      }
    });
  }
  return drive;
}

/// A drive as the input's script disturbs it: commands of four bytes - what to do, to which packet, at which
/// byte, with what.
std::vector<packets::Received> played(Bytes script) {
  static const std::vector<packets::Received> drive = sparse_drive();
  std::vector<packets::Received> out;
  out.reserve(kPackets);
  const auto byte = [&](std::size_t i) { return static_cast<std::uint8_t>(script[i]); };
  for (std::size_t i = 0; i + kCommandBytes <= std::min(script.size(), kPackets * kCommandBytes);
       i += kCommandBytes) {
    packets::Received packet = drive[byte(i + 1) % kPackets];
    if (byte(i) % 4 == 1) packet.bytes[(byte(i + 2) * 5U) % velodyne::kDataBytes] = script[i + 3];
    if (byte(i) % 4 == 2) packet.bytes[1200 + byte(i + 2) % 6U] = script[i + 3];
    if (byte(i) % 4 == 3) packet.time_ns += (byte(i + 2) - 128) * 60'000'000'000LL * byte(i + 3);
    out.push_back(packet);
  }
  return out;
}

}  // namespace

std::vector<std::string> seeds() {
  std::string straight;
  std::string shuffled;
  for (int i = 0; i < static_cast<int>(kPackets); ++i) {
    straight += std::string(1, '\0') + static_cast<char>(i) + "  ";
    shuffled += std::string(1, static_cast<char>(i % 5)) + static_cast<char>(i ^ 3) +
                static_cast<char>(7 * i) + static_cast<char>(i);
  }
  const std::size_t half = straight.size() / 2;
  return {straight, shuffled, shuffled.substr(0, half) + straight.substr(half), ""};
}

void check(Bytes input) {
  const auto script = played(input);
  const auto once = packets::decode(script);
  const auto twice = packets::decode(script);
  require(packets::adds_up(once.counters));
  require(once.revolutions.size() == twice.revolutions.size());
  for (std::size_t k = 0; k < once.revolutions.size(); ++k) {
    const Cloud& cloud = once.revolutions[k].cloud;
    require(packets::same_bits(cloud, twice.revolutions[k].cloud));
    for (const double time_s : cloud.time_s) require(std::isfinite(time_s) && std::abs(time_s) < 10.0);
  }
}

}  // namespace verge::fuzz
