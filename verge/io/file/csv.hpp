// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string_view>

#include "verge/io/file/decoded.hpp"
#include "verge/io/input.hpp"

namespace verge::io {

/// A table of points as text, one a line: paper 2's table (Table III: number, level, distance, x, y, z), or
/// any with a header line that names x, y and z.
///
/// Cells are parted by commas, semicolons or tabs (what the first line has), may stand in double quotes, and
/// hold numbers with a decimal point, whatever the locale. A first line with a cell that is no number is the
/// header; names are those of columns.hpp, units behind them ("x [m]", "x (m)", "x_m") do not count, columns
/// of other names (number, distance) are checked to be numbers and left out. Without a header 6 columns are
/// paper 2's table, 4 are x, y, z, intensity, 3 are x, y, z. level is the ring. Blank lines are skipped.
///
/// Fails with kUnusable at the line and column where: a cell is no number, a row has not the header's number
/// of cells, a quote stays open, a byte is NUL, a line is longer than 64 KiB, more than 256 columns, a
/// decimal comma stands.
[[nodiscard]] Expected<Decoded> read_csv(Input& input);

/// The scan as such a table with a header, in the input's order, atomically: number (from 1), level (the
/// ring), distance, x, y, z in metres as in paper 2's Table III, then, where the scan has them, intensity,
/// timestamp_s (seconds with nine decimals, absolute where the scan has a stamp), echo, pulse_width, flags,
/// label. Numbers have as many digits as bring them back bit for bit.
[[nodiscard]] Expected<void> write_csv(const std::filesystem::path& path, const Scan& scan);

/// Whether the text begins like such a table: a header that names x, y, z, or a first line of 3, 4 or 6
/// numbers.
[[nodiscard]] bool looks_like_table(std::string_view head);

}  // namespace verge::io
