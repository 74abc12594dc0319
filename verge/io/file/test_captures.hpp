// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

// Captures for tests, byte by byte, apart from the writer that is tested.

namespace verge::testing {

/// A number in the byte order of the file.
[[nodiscard]] std::string u16(std::uint32_t value, bool big);
[[nodiscard]] std::string u32(std::uint32_t value, bool big);

/// How a capture is made.
struct CapturePlan {
  std::uint32_t link_type = 1;
  bool big_endian = false;
  bool nanoseconds = false;
};

[[nodiscard]] std::string pcap_header(const CapturePlan& plan = {});
/// A record; `original` is the frame's length before the capture cut it (0: as it is).
[[nodiscard]] std::string pcap_record(const std::string& frame, std::int64_t time_ns,
                                      const CapturePlan& plan = {}, std::uint32_t original = 0);

/// An IPv4 packet with UDP.
struct UdpPlan {
  std::uint32_t source = 0xC0A801C9;
  std::uint16_t port = 2368;
  std::string options{};       ///< Of IPv4; a multiple of 4 bytes.
  int length_off = 0;          ///< Added to the UDP length.
  std::uint32_t checksum = 0;  ///< Of UDP; 0 = none.
};
[[nodiscard]] std::string udp(const std::string& payload, const UdpPlan& plan = {});
[[nodiscard]] std::string ipv4(const std::string& body, const UdpPlan& plan = {}, std::uint32_t fragment = 0);
[[nodiscard]] std::string ipv6(const std::string& body, std::uint8_t next = 17);
/// The IP packet in a frame of that link type, behind so many VLAN tags.
[[nodiscard]] std::string frame_of(const std::string& ip, std::uint32_t link_type = 1, int tags = 0);

/// Data packets of an HDL-32E at 10 Hz, from the rear on: payloads of 1206 bytes, and when they were sent.
struct SensorPacket {
  std::string payload;
  std::int64_t time_ns = 0;
};
[[nodiscard]] std::vector<SensorPacket> sensor_packets(std::size_t count);

/// A capture of them.
[[nodiscard]] std::string capture_of(const std::vector<SensorPacket>& packets, const CapturePlan& plan = {},
                                     const UdpPlan& udp_plan = {});

/// Blocks of a pcapng.
[[nodiscard]] std::string ng_block(std::uint32_t type, const std::string& body, bool big = false);
[[nodiscard]] std::string ng_section(bool big = false);
[[nodiscard]] std::string ng_interface(const std::string& options = {}, bool big = false);
[[nodiscard]] std::string ng_packet(const std::string& frame, std::int64_t time_ns, bool big = false);

}  // namespace verge::testing
