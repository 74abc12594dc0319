// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "verge/scan/organise.hpp"
#include "verge/sensor/velodyne/packet.hpp"

namespace verge::sensor::velodyne {

/// A data packet ready to be sent.
struct SentPacket {
  DataBytes bytes{};
  std::int64_t time_ns = 0;  ///< Of its first firing, since the Unix epoch: when it is recorded.
};

/// How the head turned while a cloud was seen.
struct Turning {
  std::int64_t begin_ns = 0;       ///< Time of the first step (Facts::step_ns), since the Unix epoch.
  double begin_azimuth_rad = 0.0;  ///< Of the head at that time, clockwise from ahead.
  double rate_hz = 10.0;           ///< Revolutions a second.
};

/// What became of the points of clouds that were encoded; the last three add up to the first.
struct EncodedPoints {
  std::uint64_t points = 0;
  std::uint64_t encoded = 0;
  std::uint64_t not_on_wire = 0;  ///< No such ring or time, not finite, or farther than the wire can say.
  std::uint64_t displaced = 0;    ///< A nearer point has its place.
};

/// Packets of a sensor in single-return mode out of clouds: the decoder's inverse, to the steps of the wire
/// (range_step_m of range, a hundredth of a degree of azimuth, whole intensities). Each step's azimuth is
/// that of the head at its time, so that a cloud that was decoded gives the packets it came from.
class Encoder {
 public:
  /// For a model without two banks. Throws std::invalid_argument for others.
  explicit Encoder(Model model);

  /// The points of one revolution that begins at `turning.begin_ns`, and must not begin before what was added
  /// before ended; `cloud.ring` (0 = lowest) and `cloud.time_s` (after `stamp_ns`) say which shot a point is
  /// of. A cloud without them encodes nothing. Steps from the last revolution's last one to this one's first
  /// one follow each other without a gap if `begin_ns` lies whole steps later.
  void add(const Cloud& cloud, std::int64_t stamp_ns, const Turning& turning, std::int64_t end_ns);

  /// The packets that are full.
  [[nodiscard]] std::vector<SentPacket> take();
  /// The last one too, its empty blocks filled by steps without returns.
  [[nodiscard]] std::vector<SentPacket> finish();

  [[nodiscard]] const EncodedPoints& counters() const { return counters_; }

 private:
  void append(const RawBlock& block, std::int64_t time_ns);

  const Facts& facts_;
  std::vector<std::size_t> laser_of_ring_;
  RawPacket packet_;
  std::size_t blocks_ = 0;  // in packet_
  std::int64_t packet_ns_ = 0;
  double step_turn_ = 0.0;  // hundredths of a degree
  std::vector<SentPacket> full_;
  EncodedPoints counters_;
};

}  // namespace verge::sensor::velodyne
