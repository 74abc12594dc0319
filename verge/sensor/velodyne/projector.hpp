// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "verge/core/bytes.hpp"
#include "verge/scan/organise.hpp"
#include "verge/sensor/velodyne/packet.hpp"

namespace verge::sensor::velodyne {

/// What became of the measurements of used blocks; the last five add up to the first.
struct PointCounters {
  std::uint64_t measured = 0;   ///< Slots of used blocks.
  std::uint64_t used = 0;       ///< Points handed out.
  std::uint64_t no_return = 0;  ///< Distance 0.
  std::uint64_t below_min = 0;  ///< Nearer than the least range.
  std::uint64_t above_max = 0;  ///< Farther than the greatest.
  std::uint64_t same_echo = 0;  ///< The second echo is the first one again.
};

/// Points of one packet on their way into a Cloud, column by column.
struct PointBatch {
  static constexpr std::size_t kMost = kBlocksPerPacket * kSlotsPerBlock;
  std::size_t size = 0;
  std::array<float, kMost> x{}, y{}, z{}, intensity{};
  std::array<std::int64_t, kMost> ring{};
  std::array<double, kMost> time_s{};
  std::array<std::uint8_t, kMost> echo{};
};

/// Makes points of measurements, with everything about the lasers worked out before.
class Projector {
 public:
  Projector(const Facts& facts, const Calibration& calibration, double range_min_m, double range_max_m);

  /// Appends the returns of a block, whose step began `time_s` after the cloud's first point. Where `other`
  /// is the block with the other echo, each return is its laser's echo 0 if it is the nearer, 1 if the
  /// farther.
  void add(Bytes packet, std::size_t block, const PlannedBlock& plan, double time_s, const std::size_t* other,
           PointBatch& batch, PointCounters& counters) const;

 private:
  using Floats = std::array<float, kSlotsPerBlock>;
  using Counts = std::array<std::uint16_t, kSlotsPerBlock>;

  /// The lasers behind the slots of a block.
  struct Bank {
    Floats ahead{}, aside{}, up{};  // cos(elevation) cos and sin(azimuth against the head's), sin(elevation)
    Floats distance{};              // added to each, metres
    Counts count_min{}, count_span{};  // least count of distance in range, and how many more there are
    std::array<std::int64_t, kSlotsPerBlock> ring{};
    std::array<LaserCorrection, kSlotsPerBlock> correction{};
    bool shifted = false;  // beams do not start in the origin, or have corrections for near points
  };
  /// Measurements of a block, and the points that they would be.
  struct Lanes {
    Counts distance{};
    Floats x{}, y{}, z{}, intensity{};
    std::array<std::uint8_t, kSlotsPerBlock> valid{};
    bool all_valid = false;
  };

  [[nodiscard]] static Bank make_bank(const Facts& facts, const Calibration& calibration, std::size_t bank,
                                      double range_min_m, double range_max_m);
  static void load(Bytes packet, std::size_t block, Lanes& lanes);
  static void judge(const Bank& bank, Lanes& lanes, PointCounters& counters);
  void place(const Bank& bank, const PlannedBlock& plan, Lanes& lanes) const;
  void shift(const Bank& bank, const PlannedBlock& plan, Lanes& lanes) const;
  void append(const Bank& bank, const Lanes& lanes, double time_s, PointBatch& batch) const;

  float range_step_m_;
  Floats slot_time_ns_{};
  std::array<double, kSlotsPerBlock> slot_time_s_{};
  std::vector<Bank> banks_;
};

/// Hands the batch's points on to the cloud, and empties it.
void move_points(PointBatch& batch, Cloud& cloud, bool with_echo);

}  // namespace verge::sensor::velodyne
