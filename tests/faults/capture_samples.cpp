// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/faults/capture_samples.hpp"

#include <algorithm>

namespace verge::faults {

namespace velodyne = sensor::velodyne;

Packets packets_of(const velodyne::testing::StreamPlan& plan) {
  Packets all;
  for (const velodyne::testing::Received& packet : velodyne::testing::stream(plan)) {
    all.push_back({std::string(reinterpret_cast<const char*>(packet.bytes.data()), packet.bytes.size()),
                   packet.time_ns});
  }
  return all;
}

Packets packets() { return packets_of({.packets = kPackets}); }

void change(testing::SensorPacket& packet,
            const std::function<void(velodyne::RawPacket&)>& to_something_else) {
  velodyne::RawPacket raw =
      velodyne::parse_packet(std::as_bytes(std::span(packet.payload.data(), packet.payload.size())));
  to_something_else(raw);
  const velodyne::DataBytes bytes = velodyne::to_bytes(raw);
  std::copy_n(reinterpret_cast<const char*>(bytes.data()), bytes.size(), packet.payload.begin());
}

std::string record_of(const testing::SensorPacket& packet, const testing::UdpPlan& plan) {
  return testing::pcap_record(testing::frame_of(testing::ipv4(testing::udp(packet.payload, plan), plan)),
                              packet.time_ns);
}

std::string capture_with(const Packets& all,
                         const std::function<std::string(const std::string&)>& frame_of_payload,
                         const testing::CapturePlan& plan) {
  std::string capture = testing::pcap_header(plan);
  for (const testing::SensorPacket& packet : all) {
    capture += testing::pcap_record(frame_of_payload(packet.payload), packet.time_ns, plan);
  }
  return capture;
}

}  // namespace verge::faults
