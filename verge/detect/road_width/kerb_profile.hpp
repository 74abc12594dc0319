// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "verge/core/vec.hpp"
#include "verge/fit/line.hpp"

namespace verge::detect::road_width {

/// What ended a line on one side of the road.
enum class SightKind : std::uint8_t {
  kKerb,   ///< An edge.
  kOpen,   ///< Nothing within reach.
  kThing,  ///< Something that stands there, and hides how the kerb runs.
};

/// Where a line ended on one side of the road. `along_m` is where it crossed the kerb's line, or where the
/// thing stands: the way at the scan, and how far ahead.
struct KerbSight {
  double along_m = 0.0;
  double ahead_m = 0.0;  ///< Of the vehicle at that scan.
  SightKind kind = SightKind::kKerb;
  Vec2 from{};                                 ///< The vehicle, in the world.
  Vec2 end{};                                  ///< In the world.
  Vec2 opposite{};                             ///< The line's other end, ...
  SightKind opposite_kind = SightKind::kKerb;  ///< ... and what it is.
};

/// The straight kerb of one side.
struct StraightKerb {
  fit::Line line{};      ///< In the world.
  double outward = 1.0;  ///< Sign of fit::signed_distance away from the road.
  double sigma_m = 0.0;  ///< Of one sight across the line.

  [[nodiscard]] double outward_m(Vec2 p) const { return outward * fit::signed_distance(line, p); }
};

/// A sight against the straight kerb.
struct KerbPoint {
  double along_m = 0.0;
  double outward_m = 0.0;  ///< Away from the road, metres.
  /// Of an open line: how far ahead of the vehicle and how far to its side it crossed the kerb's line. A kerb
  /// that has turned away from that direction is not seen.
  std::optional<Vec2> open{};
};

/// The ends of all four lines on one side over the way: where the kerb runs, whichever line saw it and when.
class KerbProfile {
 public:
  /// In any order; kept in that of `along_m`.
  void see(const KerbSight& sight);
  void forget_before(double along_m);
  /// The first place; 0 where nothing was seen.
  [[nodiscard]] double begin_m() const { return sights_.empty() ? 0.0 : sights_.front().along_m; }

  /// The line through the edges between two places, but for those apart from most of them. `heading` is the
  /// road's direction, `left` the side. None where there are fewer than eight, or they
  /// take up less than 3 m.
  [[nodiscard]] std::optional<StraightKerb> straight(double from_m, double to_m, Vec2 heading,
                                                     bool left) const;
  /// All sights from a place on against a straight kerb; a thing less than 0.6 m behind it, as cars park,
  /// stands on it, and an open line goes on for 4 m at the least, however narrow the field of view. `other`,
  /// the other side's one where it is known, tells a bend of the road, in which one side moves in as the
  /// other moves out.
  [[nodiscard]] std::vector<KerbPoint> against(const StraightKerb& kerb, const StraightKerb* other,
                                               double from_m) const;

 private:
  std::vector<KerbSight> sights_;
};

}  // namespace verge::detect::road_width
