// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <cstdlib>
#include <string>
#include <variant>
#include <vector>

#include <fmt/core.h>

#include "verge/core/atomic_file.hpp"
#include "verge/io/file/columns.hpp"
#include "verge/io/file/csv.hpp"
#include "verge/io/file/point_table.hpp"

namespace verge::io {
namespace {

bool is_time(const TableColumn& column) { return column.name == "t" || column.name == "timestamp"; }

/// Which columns stand where in paper 2's table; the others follow.
bool is_of_table(const TableColumn& column) {
  return column.name == "x" || column.name == "y" || column.name == "z" || column.name == "ring";
}

std::string csv_header(const std::vector<TableColumn>& table) {
  std::string text = "number,level,distance,x,y,z";
  for (const TableColumn& column : table) {
    if (!is_of_table(column)) text += fmt::format(",{}", is_time(column) ? "timestamp_s" : column.name);
  }
  return text + '\n';
}

/// A number with as many digits as it needs, a time as seconds with nine decimals.
std::string cell_text(const TableColumn& column, std::size_t row) {
  constexpr std::int64_t kSecond = 1'000'000'000;
  return std::visit(
      [&](const auto& values) {
        if (!is_time(column)) return fmt::format("{}", values[row]);
        const auto ns = static_cast<std::int64_t>(values[row]);
        return fmt::format("{}{}.{:09}", ns < 0 ? "-" : "", std::abs(ns / kSecond), std::abs(ns % kSecond));
      },
      column.values);
}

std::string csv_row(const std::vector<TableColumn>& table, std::size_t row, float range) {
  std::array<std::string, 4> place;  // ring, x, y, z
  std::string rest;
  for (const TableColumn& column : table) {
    const std::string text = cell_text(column, row);
    if (!is_of_table(column)) {
      rest += ',' + text;
    } else {
      place[column.name == "ring" ? 0 : static_cast<std::size_t>(column.name.front() - 'x') + 1] = text;
    }
  }
  return fmt::format("{},{},{},{},{},{}{}\n", row + 1, place[0], range, place[1], place[2], place[3], rest);
}

}  // namespace

Expected<void> write_csv(const std::filesystem::path& path, const Scan& scan) {
  auto file = AtomicFile::create(path);
  if (!file) return Unexpected(file.error());
  const std::vector<TableColumn> table = point_table(scan, TableTime::kAbsolute);
  if (auto written = file->write(csv_header(table)); !written) return written;
  const std::vector<std::uint32_t> order = input_order(scan);
  for (std::size_t row = 0; row < scan.size(); ++row) {
    const std::string line = csv_row(table, row, scan.range[order[row]]);
    if (auto written = file->write(line); !written) return written;
  }
  return file->commit();
}

}  // namespace verge::io
