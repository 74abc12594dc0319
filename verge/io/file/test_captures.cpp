// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/io/file/test_captures.hpp"

#include <cmath>

#include "verge/sensor/velodyne/packet.hpp"

namespace verge::testing {
namespace {

std::string padded(std::string text) {
  while (text.size() % 4 != 0) text.push_back('\0');
  return text;
}

std::string u8(unsigned value) {
  return std::string(1, static_cast<char>(static_cast<unsigned char>(value)));
}

}  // namespace

std::string u16(std::uint32_t value, bool big) {
  return big ? u8(value >> 8U) + u8(value) : u8(value) + u8(value >> 8U);
}

std::string u32(std::uint32_t value, bool big) {
  return big ? u16(value >> 16U, true) + u16(value, true) : u16(value, false) + u16(value >> 16U, false);
}

std::string pcap_header(const CapturePlan& plan) {
  const bool big = plan.big_endian;
  return u32(plan.nanoseconds ? 0xA1B23C4D : 0xA1B2C3D4, big) + u16(2, big) + u16(4, big) + u32(0, big) +
         u32(0, big) + u32(262'144, big) + u32(plan.link_type, big);
}

std::string pcap_record(const std::string& frame, std::int64_t time_ns, const CapturePlan& plan,
                        std::uint32_t original) {
  const bool big = plan.big_endian;
  const auto size = static_cast<std::uint32_t>(frame.size());
  const auto part = static_cast<std::uint32_t>(time_ns % 1'000'000'000 / (plan.nanoseconds ? 1 : 1000));
  return u32(static_cast<std::uint32_t>(time_ns / 1'000'000'000), big) + u32(part, big) + u32(size, big) +
         u32(original == 0 ? size : original, big) + frame;
}

std::string udp(const std::string& payload, const UdpPlan& plan) {
  const auto length = static_cast<std::uint32_t>(static_cast<int>(payload.size()) + 8 + plan.length_off);
  return u16(443, true) + u16(plan.port, true) + u16(length, true) + u16(plan.checksum, true) + payload;
}

std::string ipv4(const std::string& body, const UdpPlan& plan, std::uint32_t fragment) {
  const auto header = static_cast<std::uint32_t>(20 + plan.options.size());
  return u8(0x40 + header / 4) + u8(0) + u16(header + static_cast<std::uint32_t>(body.size()), true) +
         u16(77, true) + u16(fragment, true) + u8(64) + u8(17) + u16(0, true) + u32(plan.source, true) +
         u32(0xFFFFFFFF, true) + plan.options + body;
}

std::string ipv6(const std::string& body, std::uint8_t next) {
  return u32(0x60000000, true) + u16(static_cast<std::uint32_t>(body.size()), true) + u8(next) + u8(64) +
         std::string(15, '\x20') + "\x01" + std::string(16, '\x21') + body;
}

std::string frame_of(const std::string& ip, std::uint32_t link_type, int tags) {
  const std::string type = u16((static_cast<unsigned char>(ip[0]) >> 4U) == 6 ? 0x86DD : 0x0800, true);
  switch (link_type) {
    case 1: {
      std::string frame(12, '\x02');
      for (int tag = 0; tag < tags; ++tag)
        frame += u16(tag + 1 < tags ? 0x88A8 : 0x8100, true) + u16(5, true);
      return frame + type + ip;
    }
    case 113:
      return std::string(14, '\0') + type + ip;
    case 276:
      return type + std::string(18, '\0') + ip;
    case 0:
      return u32(2, false) + ip;
    case 108:
      return u32(2, true) + ip;
    default:
      return ip;
  }
}

std::vector<SensorPacket> sensor_packets(std::size_t count) {
  namespace velodyne = sensor::velodyne;
  constexpr std::int64_t kBeginNs = 1'700'000'000'000'000'000;
  constexpr std::int64_t kPacketNs = 552'960;
  std::vector<SensorPacket> packets;
  for (std::size_t number = 0; number < count; ++number) {
    velodyne::RawPacket packet;
    for (std::size_t b = 0; b < velodyne::kBlocksPerPacket; ++b) {
      const double turned = 16.5888 * static_cast<double>(number * velodyne::kBlocksPerPacket + b);
      packet.blocks[b].azimuth = static_cast<std::uint16_t>((18'000 + std::llround(turned)) % 36'000);
      packet.blocks[b].distance.fill(5000);
    }
    const std::int64_t time_ns = kBeginNs + static_cast<std::int64_t>(number) * kPacketNs;
    packet.stamp_us = static_cast<std::uint32_t>(time_ns % 3'600'000'000'000 / 1000);
    const velodyne::DataBytes bytes = velodyne::to_bytes(packet);
    packets.push_back({std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size()), time_ns});
  }
  return packets;
}

std::string capture_of(const std::vector<SensorPacket>& packets, const CapturePlan& plan,
                       const UdpPlan& udp_plan) {
  std::string capture = pcap_header(plan);
  for (const SensorPacket& packet : packets) {
    capture += pcap_record(frame_of(ipv4(udp(packet.payload, udp_plan), udp_plan), plan.link_type),
                           packet.time_ns, plan);
  }
  return capture;
}

std::string ng_block(std::uint32_t type, const std::string& body, bool big) {
  const std::string rest = padded(body);
  const auto length = static_cast<std::uint32_t>(rest.size() + 12);
  return u32(type, big) + u32(length, big) + rest + u32(length, big);
}

std::string ng_section(bool big) {
  return ng_block(0x0A0D0D0A, u32(0x1A2B3C4D, big) + u16(1, big) + u16(0, big) + std::string(8, '\xFF'), big);
}

std::string ng_interface(const std::string& options, bool big) {
  return ng_block(1, u16(1, big) + u16(0, big) + u32(262'144, big) + options, big);
}

std::string ng_packet(const std::string& frame, std::int64_t time_ns, bool big) {
  const auto time_us = static_cast<std::uint64_t>(time_ns / 1000);
  const auto size = static_cast<std::uint32_t>(frame.size());
  return ng_block(6,
                  u32(0, big) + u32(static_cast<std::uint32_t>(time_us >> 32U), big) +
                      u32(static_cast<std::uint32_t>(time_us), big) + u32(size, big) + u32(size, big) + frame,
                  big);
}

}  // namespace verge::testing
