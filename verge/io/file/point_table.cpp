// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/io/file/point_table.hpp"

#include <array>
#include <bit>
#include <utility>

#include "verge/core/atomic_file.hpp"
#include "verge/scan/organise.hpp"

namespace verge::io {
namespace {

std::vector<std::uint16_t> narrow_rings(const std::vector<std::int64_t>& rings) {
  std::vector<std::uint16_t> narrow;
  narrow.reserve(rings.size());
  for (const std::int64_t ring : rings) narrow.push_back(static_cast<std::uint16_t>(ring));
  return narrow;
}

/// The scan's offsets in the order of its input.
std::vector<std::uint32_t> offsets_in_input_order(const Scan& scan) {
  std::vector<std::uint32_t> offsets;
  for (const std::uint32_t i : input_order(scan)) offsets.push_back(scan.time_offset_ns[i]);
  return offsets;
}

TableColumn time_column(const Scan& scan, TableTime time) {
  std::vector<std::uint32_t> offsets = offsets_in_input_order(scan);
  if (time == TableTime::kOffset || !scan.stamp_ns) return {"t", std::move(offsets)};
  std::vector<std::int64_t> stamps;
  stamps.reserve(offsets.size());
  for (const std::uint32_t offset : offsets) stamps.push_back(*scan.stamp_ns + offset);
  return {"timestamp", std::move(stamps)};
}

}  // namespace

std::vector<TableColumn> point_table(const Scan& scan, TableTime time) {
  Cloud cloud = flatten(scan);
  std::vector<TableColumn> table;
  const auto add = [&table](std::string_view name, auto values) {
    if (!values.empty()) table.push_back({name, std::move(values)});
  };
  add("x", std::move(cloud.x));
  add("y", std::move(cloud.y));
  add("z", std::move(cloud.z));
  add("intensity", std::move(cloud.intensity));
  add("ring", narrow_rings(cloud.ring));
  if (!scan.time_offset_ns.empty()) table.push_back(time_column(scan, time));
  add("echo", std::move(cloud.echo));
  add("pulse_width", std::move(cloud.pulse_width));
  add("flags", std::move(cloud.flags));
  add("label", std::move(cloud.label));
  return table;
}

Scalar type_of(const TableColumn& column) {
  // In the order of the variant's types.
  constexpr std::array kTypes{Scalar::kF32, Scalar::kU8, Scalar::kU16, Scalar::kU32, Scalar::kI64};
  return kTypes[column.values.index()];
}

void append_bytes(const std::vector<TableColumn>& table, std::size_t row, std::string& out) {
  static_assert(std::endian::native == std::endian::little, "big-endian hosts need a byte swap here");
  for (const TableColumn& column : table) {
    std::visit(
        [&](const auto& values) {
          const auto value = values[row];
          const auto bytes = std::bit_cast<std::array<char, sizeof(value)>>(value);
          out.append(bytes.data(), bytes.size());
        },
        column.values);
  }
}

Expected<void> write_table(const std::filesystem::path& path, std::string_view header,
                           const std::vector<TableColumn>& table, std::size_t rows) {
  auto file = AtomicFile::create(path);
  if (!file) return Unexpected(file.error());
  if (auto written = file->write(header); !written) return written;
  std::string bytes;
  for (std::size_t row = 0; row < rows; ++row) {
    bytes.clear();
    append_bytes(table, row, bytes);
    if (auto written = file->write(bytes); !written) return written;
  }
  return file->commit();
}

}  // namespace verge::io
