// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include <utility>

#include "verge/io/file/pcap.hpp"

namespace verge::io {
namespace {

/// Bytes being put together, numbers in network order (captures of ours are big-endian only inside frames).
class Frame {
 public:
  void u8(unsigned value) { bytes_.push_back(static_cast<char>(static_cast<std::uint8_t>(value))); }
  void u16(unsigned value) {
    u8(value >> 8U);
    u8(value);
  }
  void u32(std::uint32_t value) {
    u16(value >> 16U);
    u16(value);
  }
  void u32_le(std::uint32_t value) {
    for (unsigned shift = 0; shift < 32; shift += 8) u8(value >> shift);
  }
  void u16_le(unsigned value) {
    u8(value);
    u8(value >> 8U);
  }
  void append(Bytes bytes) {
    for (const std::byte b : bytes) bytes_.push_back(static_cast<char>(b));
  }
  /// The Internet checksum of what stands at [from, end), plus `more`.
  [[nodiscard]] unsigned checksum(std::size_t from, std::uint32_t more) const {
    std::uint32_t sum = more;
    for (std::size_t i = from; i < bytes_.size(); ++i) {
      const unsigned byte = static_cast<unsigned char>(bytes_[i]);
      sum += (i - from) % 2 == 0 ? byte << 8U : byte;
    }
    while (sum > 0xFFFF) sum = (sum & 0xFFFFU) + (sum >> 16U);
    return ~sum & 0xFFFFU;
  }
  void put_u16(std::size_t at, unsigned value) {
    bytes_[at] = static_cast<char>(static_cast<std::uint8_t>(value >> 8U));
    bytes_[at + 1] = static_cast<char>(static_cast<std::uint8_t>(value));
  }
  [[nodiscard]] std::size_t size() const { return bytes_.size(); }
  [[nodiscard]] std::string take() && { return std::move(bytes_); }

 private:
  std::string bytes_;
};

constexpr unsigned kUdp = 17;
constexpr std::size_t kEthernet = 14;
constexpr std::size_t kIp = 20;
constexpr std::size_t kUdpHeader = 8;

void ethernet(Frame& frame) {
  for (int i = 0; i < 6; ++i) frame.u8(0xFF);                              // broadcast
  for (const unsigned b : {0x60U, 0x76U, 0x88U, 0U, 0U, 0U}) frame.u8(b);  // 60:76:88 is the maker's
  frame.u16(0x0800);
}

void ip(Frame& frame, std::size_t payload, const PcapWriter::Route& route) {
  const std::size_t begin = frame.size();
  frame.u16(0x4500);
  frame.u16(static_cast<unsigned>(kIp + kUdpHeader + payload));
  frame.u16(0);
  frame.u16(0x4000);  // in one piece
  frame.u16(0xFF00 | kUdp);
  frame.u16(0);
  frame.u32(route.source_ip);
  frame.u32(route.destination_ip);
  frame.put_u16(begin + 10, frame.checksum(begin, 0));
}

void udp(Frame& frame, Bytes payload, const PcapWriter::Route& route) {
  const std::size_t begin = frame.size();
  const auto length = static_cast<unsigned>(kUdpHeader + payload.size());
  frame.u16(route.port);
  frame.u16(route.port);
  frame.u16(length);
  frame.u16(0);
  frame.append(payload);
  const std::uint32_t pseudo = (route.source_ip >> 16U) + (route.source_ip & 0xFFFFU) +
                               (route.destination_ip >> 16U) + (route.destination_ip & 0xFFFFU) + kUdp +
                               length;
  const unsigned sum = frame.checksum(begin, pseudo);
  frame.put_u16(begin + 6, sum == 0 ? 0xFFFF : sum);
}

}  // namespace

std::string PcapWriter::file_header() {
  Frame out;
  out.u32_le(0xA1B2C3D4);
  out.u16_le(2);
  out.u16_le(4);
  out.u32_le(0);
  out.u32_le(0);
  out.u32_le(262'144);
  out.u32_le(1);
  return std::move(out).take();
}

std::string PcapWriter::record(Bytes payload, std::int64_t time_ns, const Route& route) {
  Frame out;
  const auto length = static_cast<std::uint32_t>(kEthernet + kIp + kUdpHeader + payload.size());
  out.u32_le(static_cast<std::uint32_t>(time_ns / 1'000'000'000));
  out.u32_le(static_cast<std::uint32_t>(time_ns % 1'000'000'000 / 1000));
  out.u32_le(length);
  out.u32_le(length);
  ethernet(out);
  ip(out, payload.size(), route);
  udp(out, payload, route);
  return std::move(out).take();
}

Expected<PcapWriter> PcapWriter::create(AtomicFile file) {
  PcapWriter writer(std::move(file));
  if (auto written = writer.file_.write(file_header()); !written) return Unexpected(written.error());
  return writer;
}

Expected<void> PcapWriter::write(Bytes payload, std::int64_t time_ns, const Route& route) {
  return file_.write(record(payload, time_ns, route));
}

}  // namespace verge::io
