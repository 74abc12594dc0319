// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "verge/scan/scan.hpp"

// Inside of the scan room: which ring each point of an unorganised cloud belongs to.

namespace verge {

/// Ring of each point, numbered 0 .. count - 1 in any order; a number may have no point.
struct RingNumbers {
  std::vector<std::uint32_t> ring_of{};
  std::size_t count = 0;
  bool clear = true;     ///< False where neighbouring rings run into each other.
  std::string remark{};  ///< What more is to be said of it; may be empty.
};

/// The values of a ring field, numbered in rising order; values that do not occur get no number.
[[nodiscard]] RingNumbers rings_by_field(std::span<const std::int64_t> field);

/// From which azimuth the rings of a cloud may start that stands ring by ring.
enum class Seam : std::uint8_t {
  kUsual,  ///< Straight ahead (KITTI) or straight behind (flattened range images).
  kAny,    ///< Anywhere: found where the elevation steps, good to about a point.
};

/// The rings of a cloud whose points stand ring by ring, each ring turning once, either way, from a common
/// azimuth (as KITTI's files do); none where the points do not stand so. `scan` has its azimuths and ranges.
/// Looked for: steps that keep one direction, at least four turns, and turns that are thin in elevation and
/// go steadily up or down, which no shuffled, column-major or voxel-ordered cloud shows.
[[nodiscard]] std::optional<RingNumbers> rings_by_order(const Scan& scan, Seam seam);

/// Groups of elevation: valleys in the histogram of elevation part one ring from the next. Where no rings can
/// be told apart (a map, a mesh), bands of 0.4 degrees. Points of range 0 go to ring 0. Does not depend on
/// the order of the points.
[[nodiscard]] RingNumbers rings_by_elevation(const Scan& scan);

}  // namespace verge
