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
constexpr std::size_t kMostCommands = 1024;

/// A drive as the input's script disturbs it: commands of four bytes - what to do, to which packet, at which
/// byte, with what.
std::vector<packets::Received> played(Bytes script) {
  static const std::vector<packets::Received> drive = packets::stream({.rate_hz = 20.0, .packets = 256});
  std::vector<packets::Received> out;
  const auto byte = [&](std::size_t i) { return static_cast<std::uint8_t>(script[i]); };
  for (std::size_t i = 0; i + kCommandBytes <= std::min(script.size(), kMostCommands * kCommandBytes);
       i += kCommandBytes) {
    packets::Received packet = drive[byte(i + 1)];
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
  for (int i = 0; i < 256; ++i) {
    straight += std::string(1, '\0') + static_cast<char>(i) + "  ";
    shuffled += std::string(1, static_cast<char>(i % 5)) + static_cast<char>(i ^ 3) +
                static_cast<char>(7 * i) + static_cast<char>(i);
  }
  return {straight, shuffled, shuffled + straight, ""};
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
