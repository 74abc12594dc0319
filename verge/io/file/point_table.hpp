// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "verge/core/error.hpp"
#include "verge/io/file/columns.hpp"
#include "verge/scan/scan.hpp"

namespace verge::io {

/// A column of a table of points; the name is one of columns.hpp.
struct TableColumn {
  std::string_view name;
  std::variant<std::vector<float>, std::vector<std::uint8_t>, std::vector<std::uint16_t>,
               std::vector<std::uint32_t>, std::vector<std::int64_t>>
      values;
};

/// How the table says when a point was seen.
enum class TableTime : std::uint8_t {
  kAbsolute,  ///< timestamp, int64 ns since the Unix epoch, where the scan has a stamp; else as kOffset.
  kOffset,    ///< t, uint32 ns since the scan's first point.
};

/// What a scan says of its points, in the input's order, as PCD, PLY and CSV write it: x, y, z, then, where
/// the scan has them, intensity, ring (always), time, echo, pulse_width, flags, label.
[[nodiscard]] std::vector<TableColumn> point_table(const Scan& scan, TableTime time);

/// Type of the column's numbers.
[[nodiscard]] Scalar type_of(const TableColumn& column);

/// Appends row `row` as little-endian bytes, column by column.
void append_bytes(const std::vector<TableColumn>& table, std::size_t row, std::string& out);

/// A header and `rows` rows of bytes as the file `path`, atomically.
[[nodiscard]] Expected<void> write_table(const std::filesystem::path& path, std::string_view header,
                                         const std::vector<TableColumn>& table, std::size_t rows);

}  // namespace verge::io
