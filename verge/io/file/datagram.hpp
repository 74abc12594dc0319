// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <compare>
#include <cstdint>
#include <deque>
#include <string>
#include <vector>

#include "verge/core/bytes.hpp"

namespace verge::io {

/// An IPv4 or IPv6 address.
struct IpAddress {
  std::array<std::uint8_t, 16> bytes{};  ///< Of IPv4 the first four.
  bool v6 = false;
  auto operator<=>(const IpAddress&) const = default;  // NOLINT(readability-implicit-bool-conversion)
};

/// "192.168.1.201", or eight groups of hexadecimal digits.
[[nodiscard]] std::string to_string(const IpAddress& address);

/// A UDP datagram; the payload is valid until the next call of DatagramReader::read().
struct Datagram {
  IpAddress source;
  std::uint16_t port = 0;  ///< Of the destination.
  Bytes payload;
};

/// What a captured frame was.
enum class FrameKind : std::uint8_t {
  kUdp,        ///< With what went before, a whole datagram.
  kFragment,   ///< Of a datagram whose other fragments are to come.
  kNotUdp,     ///< Another protocol.
  kCut,        ///< The capture kept only its begin.
  kMalformed,  ///< Lengths contradict each other.
};

/// Takes frames of a capture apart: Ethernet (VLAN, QinQ), Linux cooked v1 and v2, raw IP, loopback; IPv4
/// with options, IPv6 with extension headers; fragments are put together again, at most 16 datagrams at a
/// time.
class DatagramReader {
 public:
  /// Link types as in capture files (https://www.tcpdump.org/linktypes.html).
  [[nodiscard]] static bool reads(int link_type);
  explicit DatagramReader(int link_type) : link_type_(link_type) {}

  /// One frame. `datagram` is set where the kind is kUdp.
  [[nodiscard]] FrameKind read(Bytes frame, Datagram& datagram);

  /// Datagrams of which fragments never came: given up so far, and waiting.
  [[nodiscard]] std::uint64_t incomplete() const { return given_up_ + partial_.size(); }
  /// Datagrams, used nevertheless, whose UDP length is shorter than IP says, or whose checksum is wrong.
  [[nodiscard]] std::uint64_t odd_lengths() const { return odd_lengths_; }
  [[nodiscard]] std::uint64_t bad_checksums() const { return bad_checksums_; }

 private:
  /// An IP packet, or a fragment of one.
  struct IpPacket {
    IpAddress source, destination;
    std::uint8_t protocol = 0;
    std::uint32_t id = 0;
    std::size_t offset = 0;  // of the fragment
    bool more = false;       // fragments follow
    Bytes body;
  };
  struct Partial {
    IpAddress source, destination;
    std::uint8_t protocol = 0;
    std::uint32_t id = 0;
    std::vector<std::byte> bytes;
    std::vector<bool> there;  // every 8 bytes
    std::size_t end = 0;      // 0: the last fragment is not there
  };

  [[nodiscard]] static FrameKind read_ipv4(Bytes bytes, IpPacket& packet);
  [[nodiscard]] static FrameKind read_ipv6(Bytes bytes, IpPacket& packet);
  [[nodiscard]] FrameKind read_ip(Bytes bytes, Datagram& datagram);
  [[nodiscard]] FrameKind collect(const IpPacket& packet, Datagram& datagram);
  [[nodiscard]] Partial& partial_of(const IpPacket& packet);
  [[nodiscard]] FrameKind read_udp(const IpPacket& packet, Datagram& datagram);

  int link_type_;
  std::deque<Partial> partial_;
  std::vector<std::byte> whole_;  // the datagram last put together
  std::uint64_t given_up_ = 0;
  std::uint64_t odd_lengths_ = 0;
  std::uint64_t bad_checksums_ = 0;
};

}  // namespace verge::io
