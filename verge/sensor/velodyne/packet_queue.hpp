// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
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

  PacketQueue() : slots_(kSlots) {}

  /// Whether this very packet was among the newest ones (those held, and as many before).
  [[nodiscard]] bool seen(Bytes payload) const;

  /// Takes a packet in; false if it is late: a newer one has been handed out.
  bool push(std::int64_t time_ns, Bytes payload);

  /// The oldest packet, if more than kHeld wait; else nothing. Valid until the next push().
  [[nodiscard]] const Packet* pop();
  /// The oldest packet, however few wait: at the end, and where the sensor's clock was set.
  [[nodiscard]] const Packet* drain();
  /// Forgets what was handed out: the times start anew.
  void restart();

 private:
  static constexpr std::size_t kSlots = 2 * kHeld + 2;

  std::vector<Packet> slots_;                  // the newest packets, each overwritten in its turn
  std::array<std::uint64_t, kSlots> tails_{};  // stamp, mode and product of each: they differ first
  std::size_t next_ = 0;                       // the slot to fill
  std::size_t filled_ = 0;
  std::vector<std::size_t> waiting_;  // slots by time
  std::optional<std::int64_t> handed_out_ns_;
};

}  // namespace verge::sensor::velodyne
