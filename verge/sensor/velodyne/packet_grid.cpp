// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/sensor/velodyne/packet_grid.hpp"

#include <algorithm>
#include <cstdlib>
#include <limits>

namespace verge::sensor::velodyne {
namespace {

constexpr std::int64_t kMicrosecondNs = 1000;
constexpr std::int64_t kStampSlackNs = 2 * kMicrosecondNs;  // packets are stamped in whole microseconds

std::int64_t rounded_ratio(std::int64_t a, std::int64_t b) {
  return a >= 0 ? (a + b / 2) / b : -((-a + b / 2) / b);
}

}  // namespace

PacketGrid::PacketGrid(const Facts& facts, std::size_t firings_per_packet)
    : has_clock_(facts.has_clock),
      firing_ns_(facts.step_ns * static_cast<std::int64_t>(facts.lasers_per_firing) /
                 static_cast<std::int64_t>(kSlotsPerBlock)),
      firings_(static_cast<std::int64_t>(firings_per_packet)) {}

std::optional<PacketGrid::Place> PacketGrid::place(std::int64_t time_ns,
                                                   std::span<const std::int64_t> ahead) {
  if (!packet_ns_) open_first(time_ns, ahead);
  auto firing = nearest_firing(time_ns);
  if (firing == firings_) open_next(time_ns);
  firing = nearest_firing(time_ns);
  if (firing < 0) return std::nullopt;
  return Place{*packet_ns_, static_cast<std::size_t>(std::min(firing, firings_ - 1))};
}

/// Of the newest packet; -1 before it, firings_ behind it.
std::int64_t PacketGrid::nearest_firing(std::int64_t time_ns) const {
  return std::clamp<std::int64_t>(rounded_ratio(time_ns - *packet_ns_, firing_ns_), -1, firings_);
}

bool PacketGrid::is_whole(std::int64_t packet_ns) const {
  return !has_clock_ || packet_ns % kMicrosecondNs == 0;
}

/// How many of the times do not fit where the first of them is that firing of its packet.
std::size_t PacketGrid::misfits(std::size_t firing, std::span<const std::int64_t> times) const {
  PacketGrid grid = *this;
  grid.packet_ns_ = times.front() - static_cast<std::int64_t>(firing) * firing_ns_;
  std::size_t count = grid.is_whole(*grid.packet_ns_) ? 0U : 1U;
  for (const std::int64_t time_ns : times) {
    const std::int64_t nearest = grid.nearest_firing(time_ns);
    if (nearest == firings_) {
      grid.open_next(time_ns);
      count += grid.is_whole(*grid.packet_ns_) ? 0U : 1U;
    } else if (std::abs(time_ns - *grid.packet_ns_ - nearest * firing_ns_) > kMicrosecondNs / 2) {
      ++count;
    }
  }
  return count;
}

/// The first firing seen is the first of its packet, unless the times tell otherwise.
void PacketGrid::open_first(std::int64_t time_ns, std::span<const std::int64_t> ahead) {
  std::size_t best = 0;
  std::size_t least = std::numeric_limits<std::size_t>::max();
  for (std::size_t firing = 0; firing < static_cast<std::size_t>(firings_) && !ahead.empty(); ++firing) {
    const std::size_t count = misfits(firing, ahead);
    if (count < least) {
      best = firing;
      least = count;
    }
  }
  packet_ns_ = time_ns - static_cast<std::int64_t>(best) * firing_ns_;
}

/// The packet that a firing behind the newest one is of: as the period goes on or, where its begin were no
/// whole microsecond so, the nearest firing that makes it one.
void PacketGrid::open_next(std::int64_t time_ns) {
  const std::int64_t packet = firings_ * firing_ns_;
  const std::int64_t after_ns = time_ns - *packet_ns_;
  const std::int64_t packets = std::max<std::int64_t>(1, (after_ns + kStampSlackNs) / packet);
  const std::int64_t expected = rounded_ratio(after_ns - packets * packet, firing_ns_);
  const std::int64_t likely = std::clamp<std::int64_t>(expected, 0, firings_ - 1);
  std::int64_t best = likely;
  for (std::int64_t off = 0; off < firings_; ++off) {
    const auto fits = [&](std::int64_t firing) {
      const std::int64_t begin_ns = time_ns - firing * firing_ns_;
      return firing >= 0 && firing < firings_ && begin_ns % kMicrosecondNs == 0 &&
             begin_ns >= *packet_ns_ + packet - firing_ns_ / 2;
    };
    if (!has_clock_) break;
    if (!fits(likely + off) && !fits(likely - off)) continue;
    best = fits(likely + off) ? likely + off : likely - off;
    break;
  }
  packet_ns_ = time_ns - best * firing_ns_;
}

}  // namespace verge::sensor::velodyne
