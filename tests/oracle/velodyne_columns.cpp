// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0

// HDL-32E data packets from standard input, one after the other; what our decoder makes of each measurement
// to standard output, for velodyne_decoder.py: packet, ring, distance, intensity as u32, azimuth (hundredths
// of a degree) and time (us of the hour) as f64. Each packet is decoded by itself.
#include <cstdint>
#include <cstdio>
#include <cstring>

#include "verge/sensor/velodyne/packet.hpp"

namespace {

namespace velodyne = verge::sensor::velodyne;

struct Shot {
  std::uint32_t packet, ring, distance, intensity;
  double azimuth, time_us;
};

void write_shots(const velodyne::DataBytes& bytes, std::uint32_t number) {
  static const velodyne::Facts& facts = velodyne::facts_of(velodyne::Model::kHdl32e);
  static const auto rings = velodyne::rings_of(facts.calibration);
  const velodyne::RawPacket packet = velodyne::parse_packet(bytes);
  const velodyne::PacketPlan plan = velodyne::plan_packet(bytes, facts, 0.0);
  for (std::size_t b = 0; b < velodyne::kBlocksPerPacket; ++b) {
    const velodyne::PlannedBlock& block = plan.blocks[b];
    if (!block.usable) continue;
    for (std::size_t slot = 0; slot < velodyne::kSlotsPerBlock; ++slot) {
      if (packet.blocks[b].distance[slot] == 0) continue;
      const std::int32_t slot_ns = facts.slot_time_ns[slot];
      const Shot shot{number,
                      static_cast<std::uint32_t>(rings[slot]),
                      packet.blocks[b].distance[slot],
                      packet.blocks[b].intensity[slot],
                      block.azimuth + block.turn_per_ns * slot_ns,
                      packet.stamp_us + 1e-3 * (block.step * facts.step_ns + slot_ns)};
      static_cast<void>(std::fwrite(&shot, sizeof shot, 1, stdout));
    }
  }
}

}  // namespace

int main() {
  velodyne::DataBytes bytes{};
  for (std::uint32_t number = 0; std::fread(bytes.data(), bytes.size(), 1, stdin) == 1; ++number) {
    write_shots(bytes, number);
  }
  return std::ferror(stdout) == 0 ? 0 : 1;
}
