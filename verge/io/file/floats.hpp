// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include "verge/core/bytes.hpp"
#include "verge/io/input.hpp"

namespace verge::io {

/// How far rows of float32 look like points of a scan. Looks at no more than the first 1024 rows.
struct RowCheck {
  std::size_t rows = 0;         ///< Looked at.
  std::size_t coordinates = 0;  ///< x, y, z are metres of a scan (0, or 1e-20 to 1e5 in size).
  std::size_t swapped = 0;      ///< They would be, were they big-endian.
  std::size_t intensities = 0;  ///< Fourth column in 0..255.
  std::size_t rings = 0;        ///< Fifth column integral in 0..127 (0 where there is none).

  [[nodiscard]] bool plausible() const { return 2 * coordinates >= rows; }
  [[nodiscard]] bool all_coordinates() const { return rows > 0 && 100 * coordinates >= 99 * rows; }
  [[nodiscard]] bool is_big_endian() const { return 2 * swapped > rows && 2 * coordinates < rows; }
  [[nodiscard]] bool has_intensities() const { return 100 * intensities >= 99 * rows; }
  [[nodiscard]] bool has_rings() const { return 100 * rings >= 99 * rows; }
};

/// Rows of `columns` (4 or 5) float32; what is left over behind the last whole row does not count.
[[nodiscard]] RowCheck check_rows(Bytes bytes, std::size_t columns);

/// Fails with kUnusable where most of the coordinates cannot be metres of a scan.
[[nodiscard]] Expected<void> check_coordinates(const Input& input, Bytes bytes, std::size_t columns);

/// The greatest ring that a .bin may name.
inline constexpr float kRingMax = 127.0F;
[[nodiscard]] bool is_bin_ring(float value);

}  // namespace verge::io
