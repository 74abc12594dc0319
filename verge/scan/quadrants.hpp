// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "verge/core/vec.hpp"
#include "verge/scan/mount.hpp"
#include "verge/scan/scan.hpp"

namespace verge {

/// The four regions of paper 3, II-1 (2), in the level frame along the road (x forward, y left). The paper's
/// x points right and its y forward: a: x > 0, y > 0; b: x < 0, y > 0; c: x > 0, y < 0; d: x < 0, y < 0.
enum class Quadrant : std::uint8_t {
  kA,  ///< Front right.
  kB,  ///< Front left.
  kC,  ///< Rear right.
  kD,  ///< Rear left.
};
inline constexpr std::array kQuadrants{Quadrant::kA, Quadrant::kB, Quadrant::kC, Quadrant::kD};

/// The region of a point of the level frame; an axis belongs to its left and its front.
[[nodiscard]] constexpr Quadrant quadrant_of(Vec3 p) {
  if (p.x >= 0.0) return p.y >= 0.0 ? Quadrant::kB : Quadrant::kA;
  return p.y >= 0.0 ? Quadrant::kD : Quadrant::kC;
}

[[nodiscard]] constexpr bool is_front(Quadrant q) { return q == Quadrant::kA || q == Quadrant::kB; }
[[nodiscard]] constexpr bool is_right(Quadrant q) { return q == Quadrant::kA || q == Quadrant::kC; }

/// +1 where walking from the road's axis outward is counter-clockwise (b, c), -1 where it is clockwise (a,
/// d). Along a scan line taken counter-clockwise a kerb's heights increase in b and c and decrease in a and
/// d: this is the sign of the gradient (A2.2-1).
[[nodiscard]] constexpr int outward_sign(Quadrant q) {
  return q == Quadrant::kB || q == Quadrant::kC ? 1 : -1;
}

/// The returns of one scan line in one region, in the level frame, from the road's axis outward.
struct QuadrantRing {
  std::size_t ring = 0;  ///< Of the scan, 0 = lowest.
  Quadrant region = Quadrant::kA;
  double elevation_rad = 0.0;  ///< Mean of the ring's returns in the sensor's frame, by range.
  double spacing_rad = 0.0;    ///< Median angle between neighbouring returns of the ring.
  std::vector<Vec3> points;
};

/// What the height gate leaves of one scan line, counter-clockwise in the level frame.
struct LowRing {
  std::size_t ring = 0;
  double elevation_rad = 0.0;
  double spacing_rad = 0.0;
  std::vector<Vec3> points;
};

/// What height_gate() lets through: metres of the level frame.
struct LowGate {
  double height_max_m = 2.0;
  double lateral_max_m = 20.0;
  double forward_max_m = 30.0;  ///< Ahead and behind.
  double range_min_m = 1.5;     ///< In the plane; nearer returns are of the own vehicle.
};

/// Paper 3, II-1 (1): the returns below a height above the road and within a region of interest, by scan
/// line. Rings without such returns are left out.
[[nodiscard]] std::vector<LowRing> height_gate(const Scan& scan, const LevelFrame& frame,
                                               const LowGate& gate);

/// II-1 (2): each scan line in its four regions, empty ones left out, ordered by region and then by ring.
[[nodiscard]] std::vector<QuadrantRing> split_quadrants(const std::vector<LowRing>& low);

}  // namespace verge
