// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include <string>
#include <vector>

#include <fmt/core.h>

#include "verge/io/file/columns.hpp"
#include "verge/io/file/pcd.hpp"
#include "verge/io/file/point_table.hpp"

namespace verge::io {
namespace {

/// One header line of a PCD file: its key and an entry for each column.
template <class Entry>
std::string header_line(std::string_view key, const std::vector<TableColumn>& table, Entry entry) {
  std::string line(key);
  for (const TableColumn& column : table) line += fmt::format(" {}", entry(column));
  return line + '\n';
}

char letter_of(Scalar type) {
  if (!is_integer(type)) return 'F';
  return type == Scalar::kI64 ? 'I' : 'U';
}

std::string header_text(const std::vector<TableColumn>& table, std::size_t points) {
  std::string text = "# .PCD v0.7 - Point Cloud Data file format\nVERSION 0.7\n";
  text += header_line("FIELDS", table, [](const TableColumn& c) { return c.name; });
  text += header_line("SIZE", table, [](const TableColumn& c) { return size_of(type_of(c)); });
  text += header_line("TYPE", table, [](const TableColumn& c) { return letter_of(type_of(c)); });
  text += header_line("COUNT", table, [](const TableColumn& /*c*/) { return 1; });
  return text +
         fmt::format("WIDTH {0}\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS {0}\nDATA binary\n", points);
}

}  // namespace

Expected<void> write_pcd(const std::filesystem::path& path, const Scan& scan) {
  const std::vector<TableColumn> table = point_table(scan, TableTime::kAbsolute);
  return write_table(path, header_text(table, scan.size()), table, scan.size());
}

}  // namespace verge::io
