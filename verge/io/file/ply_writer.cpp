// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <string>
#include <vector>

#include <fmt/core.h>

#include "verge/io/file/columns.hpp"
#include "verge/io/file/ply.hpp"
#include "verge/io/file/ply_header.hpp"
#include "verge/io/file/point_table.hpp"

namespace verge::io {
namespace {

std::string_view name_of(Scalar type) {
  constexpr std::array<std::string_view, 10> kNames{"char", "uchar", "short", "ushort", "int",
                                                    "uint", "",      "",      "float",  "double"};
  return kNames[static_cast<std::size_t>(type)];
}

std::string header_text(const std::vector<TableColumn>& table, const Scan& scan) {
  std::string text = "ply\nformat binary_little_endian 1.0\n";
  if (scan.stamp_ns) text += fmt::format("comment {}{}\n", kPlyStamp, *scan.stamp_ns);
  text += fmt::format("element vertex {}\n", scan.size());
  for (const TableColumn& column : table) {
    text += fmt::format("property {} {}\n", name_of(type_of(column)), column.name);
  }
  return text + "end_header\n";
}

}  // namespace

Expected<void> write_ply(const std::filesystem::path& path, const Scan& scan) {
  const std::vector<TableColumn> table = point_table(scan, TableTime::kOffset);
  return write_table(path, header_text(table, scan), table, scan.size());
}

}  // namespace verge::io
