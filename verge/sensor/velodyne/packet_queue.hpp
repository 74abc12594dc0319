// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <vector>

#include "verge/sensor/velodyne/packet.hpp"

namespace verge::sensor::velodyne {

/// Puts packets in the order of their times: a network may swap them, and send one twice. Holds the newest
/// kHeld packets; one that comes later than those is late.
class PacketQueue {
 public:
  static constexpr std::size_t kHeld = 16;

  struct Packet {
    std::int64_t time_ns = 0;
    DataBytes bytes{};
  };

  /// Whether this very packet was among the newest ones (those held, and as many handed out before).
  [[nodiscard]] bool seen(Bytes payload) const;

  /// Takes a packet in; false if it is late: a newer one has been handed out.
  bool push(std::int64_t time_ns, Bytes payload);

  /// The oldest packet, if more than kHeld wait.
  [[nodiscard]] std::optional<Packet> pop();
  /// The oldest packet, however few wait: at the end, and where the sensor's clock was set.
  [[nodiscard]] std::optional<Packet> drain();
  /// Forgets what was handed out: the times start anew.
  void restart();

 private:
  std::deque<Packet> waiting_;    // by time
  std::deque<DataBytes> newest_;  // by arrival
  std::optional<std::int64_t> handed_out_ns_;
};

}  // namespace verge::sensor::velodyne
