// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "verge/scan/scan.hpp"

// Inside of the scan room: how the points of a ring are put in order.

namespace verge {

/// Fills scan.azimuth and scan.range from x, y, z (radians, metres).
void measure_directions(Scan& scan);

/// Puts the indices of each ring, `order`[ring_begin[r], ring_begin[r + 1]), in order of azimuth. The order
/// is total: equal azimuths go by z, x, y, intensity, the optional columns, and only then by input_index, so
/// that it does not depend on how the points stood before, except in input_index itself. Linear time; a ring
/// that turns once, either way, costs one pass.
void sort_rings_by_azimuth(const Scan& scan, std::span<const std::uint32_t> ring_begin,
                           std::span<std::uint32_t> order);

/// Rearranges every column that is there: new point i is old point order[i].
void permute_points(Scan& scan, std::span<const std::uint32_t> order);

}  // namespace verge
