// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "verge/sensor/velodyne/facts.hpp"

namespace verge::sensor::velodyne {

/// Finds out which packets firings were sent in, from nothing but their times: within a packet they follow
/// each other by the sensor's period to the nanosecond, and each packet begins at a whole microsecond. A
/// firing is what all lasers of a bank make once: a block of a VLP-16 holds two.
class PacketGrid {
 public:
  struct Place {
    std::int64_t packet_ns = 0;  ///< Time of the packet's first firing.
    std::size_t firing = 0;      ///< Of that packet, from 0.
  };

  /// For packets of that many firings.
  PacketGrid(const Facts& facts, std::size_t firings_per_packet);

  /// Where a firing belongs: the nearest one of its packet. None where that lies before the newest packet.
  /// `ahead`: times of this and of some firings to come, in order: where nothing is known yet, they tell with
  /// which firing the first packet began.
  [[nodiscard]] std::optional<Place> place(std::int64_t time_ns, std::span<const std::int64_t> ahead);

 private:
  [[nodiscard]] std::int64_t nearest_firing(std::int64_t time_ns) const;
  [[nodiscard]] bool is_whole(std::int64_t packet_ns) const;
  void open_first(std::int64_t time_ns, std::span<const std::int64_t> ahead);
  void open_next(std::int64_t time_ns);
  [[nodiscard]] std::size_t misfits(std::size_t firing, std::span<const std::int64_t> times) const;

  bool has_clock_;
  std::int64_t firing_ns_;
  std::int64_t firings_;
  std::optional<std::int64_t> packet_ns_;  // of the newest packet
};

}  // namespace verge::sensor::velodyne
