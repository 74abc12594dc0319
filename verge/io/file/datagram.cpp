// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/io/file/datagram.hpp"

#include <algorithm>
#include <optional>
#include <utility>

#include <fmt/core.h>
#include <pcap/dlt.h>

namespace verge::io {
namespace {

constexpr std::uint16_t kIpv4 = 0x0800;
constexpr std::uint16_t kIpv6 = 0x86DD;
constexpr std::uint8_t kUdp = 17;
constexpr std::size_t kMostPartial = 16;
constexpr std::size_t kMostBytes = 65'535;

std::uint8_t byte_at(Bytes bytes, std::size_t offset) { return static_cast<std::uint8_t>(bytes[offset]); }

/// What stands behind an Ethernet type, past up to three VLAN tags.
std::optional<Bytes> behind_type(Bytes bytes, std::size_t type_at) {
  for (int tags = 0; tags <= 3; ++tags) {
    if (bytes.size() < type_at + 2) return std::nullopt;
    const auto type = load_be<std::uint16_t>(bytes, type_at);
    if (type == kIpv4 || type == kIpv6) return bytes.subspan(type_at + 2);
    const bool tag = type == 0x8100 || type == 0x88A8 || type == 0x9100;
    if (!tag) return std::nullopt;
    type_at += 4;
  }
  return std::nullopt;
}

std::optional<Bytes> behind(Bytes frame, std::size_t header) {
  if (frame.size() < header) return std::nullopt;
  return frame.subspan(header);
}

/// The IP packet in a frame; none where there is another protocol.
std::optional<Bytes> ip_of(Bytes frame, int link_type) {
  constexpr int kRawOfSomeSystems = 101;
  switch (link_type) {
    case DLT_EN10MB:
      return behind_type(frame, 12);
    case DLT_LINUX_SLL:
      return behind_type(frame, 14);
    case DLT_LINUX_SLL2: {
      const auto type = frame.size() < 20 ? 0 : load_be<std::uint16_t>(frame, 0);
      return type == kIpv4 || type == kIpv6 ? behind(frame, 20) : std::nullopt;
    }
    case DLT_NULL:
    case DLT_LOOP:
      return behind(frame, 4);
    case DLT_RAW:
    case kRawOfSomeSystems:
    case DLT_IPV4:
    case DLT_IPV6:
      return frame;
    default:
      return std::nullopt;
  }
}

IpAddress address(Bytes bytes, std::size_t offset, std::size_t length) {
  IpAddress out{.v6 = length == 16};
  for (std::size_t i = 0; i < length; ++i) out.bytes[i] = byte_at(bytes, offset + i);
  return out;
}

/// Sum of 16-bit words as the Internet checksum adds them, without the folding.
std::uint64_t sum_words(Bytes bytes) {
  std::uint64_t sum = 0;
  for (std::size_t i = 0; i + 1 < bytes.size(); i += 2) sum += load_be<std::uint16_t>(bytes, i);
  if (bytes.size() % 2 != 0) sum += static_cast<std::uint64_t>(byte_at(bytes, bytes.size() - 1)) << 8U;
  return sum;
}

bool checksum_right(const IpAddress& source, const IpAddress& destination, Bytes udp) {
  const std::size_t length = source.v6 ? 16 : 4;
  std::uint64_t sum = sum_words(std::as_bytes(std::span(source.bytes)).first(length)) +
                      sum_words(std::as_bytes(std::span(destination.bytes)).first(length)) + kUdp +
                      udp.size() + sum_words(udp);
  while (sum > 0xFFFF) sum = (sum & 0xFFFF) + (sum >> 16U);
  return sum == 0xFFFF;
}

}  // namespace

std::string to_string(const IpAddress& address) {
  const auto& b = address.bytes;
  if (!address.v6) return fmt::format("{}.{}.{}.{}", b[0], b[1], b[2], b[3]);
  std::string text;
  for (std::size_t i = 0; i < b.size(); i += 2) {
    text += fmt::format("{}{:x}", i == 0 ? "" : ":", b[i] * 256U + b[i + 1]);
  }
  return text;
}

bool DatagramReader::reads(int link_type) {
  constexpr std::array kKnown = {DLT_EN10MB, DLT_LINUX_SLL, DLT_LINUX_SLL2, DLT_NULL, DLT_LOOP,
                                 DLT_RAW,    101,           DLT_IPV4,       DLT_IPV6};
  return std::find(kKnown.begin(), kKnown.end(), link_type) != kKnown.end();
}

FrameKind DatagramReader::read(Bytes frame, Datagram& datagram) {
  const auto ip = ip_of(frame, link_type_);
  if (!ip || ip->empty()) return FrameKind::kNotUdp;
  return read_ip(*ip, datagram);
}

FrameKind DatagramReader::read_ip(Bytes bytes, Datagram& datagram) {
  IpPacket packet;
  const unsigned version = byte_at(bytes, 0) >> 4U;
  if (version != 4 && version != 6) return FrameKind::kNotUdp;
  const FrameKind kind = version == 4 ? read_ipv4(bytes, packet) : read_ipv6(bytes, packet);
  if (kind != FrameKind::kUdp) return kind;
  if (packet.more || packet.offset != 0) return collect(packet, datagram);
  return read_udp(packet, datagram);
}

/// kUdp where the packet is, or is a fragment of, a UDP datagram that is there in full.
FrameKind DatagramReader::read_ipv4(Bytes bytes, IpPacket& packet) {
  constexpr std::size_t kLeast = 20;
  if (bytes.size() < kLeast) return FrameKind::kCut;
  const std::size_t header = 4 * static_cast<std::size_t>(byte_at(bytes, 0) & 0x0FU);
  const std::size_t total = load_be<std::uint16_t>(bytes, 2);
  if (byte_at(bytes, 9) != kUdp) return FrameKind::kNotUdp;
  if (header < kLeast || total < header) return FrameKind::kMalformed;
  if (bytes.size() < total) return FrameKind::kCut;
  const auto fragment = load_be<std::uint16_t>(bytes, 6);
  packet.protocol = kUdp;
  packet.id = load_be<std::uint16_t>(bytes, 4);
  packet.offset = 8 * static_cast<std::size_t>(fragment & 0x1FFFU);
  packet.more = (fragment & 0x2000U) != 0;
  packet.source = address(bytes, 12, 4);
  packet.destination = address(bytes, 16, 4);
  packet.body = bytes.subspan(header, total - header);
  return FrameKind::kUdp;
}

FrameKind DatagramReader::read_ipv6(Bytes bytes, IpPacket& packet) {
  constexpr std::size_t kHeader = 40;
  if (bytes.size() < kHeader) return FrameKind::kCut;
  const std::size_t length = load_be<std::uint16_t>(bytes, 4);
  packet.source = address(bytes, 8, 16);
  packet.destination = address(bytes, 24, 16);
  std::uint8_t next = byte_at(bytes, 6);
  if (bytes.size() < kHeader + length) return next == kUdp ? FrameKind::kCut : FrameKind::kNotUdp;
  Bytes body = bytes.subspan(kHeader, length);
  constexpr std::uint8_t kFragment = 44;
  while (next == 0 || next == 43 || next == 60 || next == kFragment) {
    if (body.size() < 8) return FrameKind::kMalformed;
    const std::size_t extension = next == kFragment ? 8 : 8 * (std::size_t{byte_at(body, 1)} + 1);
    if (body.size() < extension) return FrameKind::kMalformed;
    if (next == kFragment) {
      const auto fragment = load_be<std::uint16_t>(body, 2);
      packet.offset = fragment & 0xFFF8U;
      packet.more = (fragment & 1U) != 0;
      packet.id = load_be<std::uint32_t>(body, 4);
    }
    next = byte_at(body, 0);
    body = body.subspan(extension);
  }
  if (next != kUdp) return FrameKind::kNotUdp;
  packet.protocol = kUdp;
  packet.body = body;
  return FrameKind::kUdp;
}

/// The datagram that a fragment belongs to; the oldest is given up where too many wait.
DatagramReader::Partial& DatagramReader::partial_of(const IpPacket& packet) {
  const auto found = std::find_if(partial_.begin(), partial_.end(), [&](const Partial& p) {
    return p.id == packet.id && p.source == packet.source && p.destination == packet.destination;
  });
  if (found != partial_.end()) return *found;
  if (partial_.size() == kMostPartial) {
    partial_.pop_front();
    ++given_up_;
  }
  partial_.push_back({packet.source, packet.destination, packet.protocol, packet.id, {}, {}, 0});
  return partial_.back();
}

FrameKind DatagramReader::collect(const IpPacket& packet, Datagram& datagram) {
  const std::size_t end = packet.offset + packet.body.size();
  const bool odd = packet.more && packet.body.size() % 8 != 0;
  if (odd || packet.body.empty() || end > kMostBytes) return FrameKind::kMalformed;
  Partial& partial = partial_of(packet);
  if (partial.bytes.size() < end) partial.bytes.resize(end);
  partial.there.resize((partial.bytes.size() + 7) / 8, false);
  std::copy(packet.body.begin(), packet.body.end(),
            partial.bytes.begin() + static_cast<std::ptrdiff_t>(packet.offset));
  for (std::size_t at = packet.offset; at < end; at += 8) partial.there[at / 8] = true;
  if (!packet.more) partial.end = end;
  const bool whole =
      partial.end != 0 && partial.bytes.size() == partial.end &&
      std::all_of(partial.there.begin(), partial.there.end(), [](bool there) { return there; });
  if (!whole) return FrameKind::kFragment;
  whole_ = std::move(partial.bytes);
  std::erase_if(partial_, [&](const Partial& p) { return &p == &partial; });
  IpPacket joined = packet;
  joined.body = whole_;
  return read_udp(joined, datagram);
}

FrameKind DatagramReader::read_udp(const IpPacket& packet, Datagram& datagram) {
  constexpr std::size_t kHeader = 8;
  if (packet.body.size() < kHeader) return FrameKind::kMalformed;
  const std::size_t length = load_be<std::uint16_t>(packet.body, 4);
  if (length < kHeader || length > packet.body.size()) return FrameKind::kMalformed;
  if (length != packet.body.size()) ++odd_lengths_;
  const Bytes udp = packet.body.first(length);
  const bool summed = load_be<std::uint16_t>(udp, 6) != 0;
  if (summed && !checksum_right(packet.source, packet.destination, udp)) ++bad_checksums_;
  datagram = {packet.source, load_be<std::uint16_t>(udp, 2), udp.subspan(kHeader)};
  return FrameKind::kUdp;
}

}  // namespace verge::io
