// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "verge/sensor/velodyne/packet.hpp"
#include "verge/sensor/velodyne/revolutions.hpp"

// Streams of packets for tests.

namespace verge::sensor::velodyne::testing {

/// A packet and when it was received.
struct Received {
  DataBytes bytes{};
  std::int64_t time_ns = 0;
};

/// How a sensor sends.
struct StreamPlan {
  Model model = Model::kHdl32e;
  std::int64_t begin_ns = 1'700'000'000'000'000'000;
  double rate_hz = 10.0;
  int begin_azimuth = 18'000;  ///< Hundredths of a degree: the cut.
  std::size_t packets = 400;
  std::uint16_t distance = 5000;
};

/// A motor that turns at its rate, measurements that name themselves: distance of slot j of block b of packet
/// p is plan.distance + (p + 7 b + 13 j) % 1000, intensity j.
[[nodiscard]] std::vector<Received> stream(const StreamPlan& plan = {});

/// The same packet by packet, changed.
[[nodiscard]] DataBytes changed(const DataBytes& bytes, const std::function<void(RawPacket&)>& change);

/// Everything that comes out of it.
struct DecodedStream {
  std::vector<Revolution> revolutions;
  Counters counters;
};
[[nodiscard]] DecodedStream decode(const std::vector<Received>& packets, const DecoderConfig& config = {});

/// Whether the counters add up, as Counters says.
[[nodiscard]] bool adds_up(const Counters& counters);

/// Whether two clouds are the same to the last bit.
[[nodiscard]] bool same_bits(const Cloud& a, const Cloud& b);

}  // namespace verge::sensor::velodyne::testing
