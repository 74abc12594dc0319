// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/io/file/pcd.hpp"

#include <string>
#include <utility>
#include <vector>

#include <fmt/core.h>

#include "verge/io/file/columns.hpp"
#include "verge/io/file/lzf.hpp"
#include "verge/io/file/pcd_header.hpp"
#include "verge/io/file/rows.hpp"
#include "verge/io/text.hpp"

namespace verge::io {
namespace {

RoleFields roles_of(const PcdHeader& header) {
  std::vector<std::string> names;
  for (const PcdField& field : header.fields) names.push_back(field.name);
  return assign_roles(names);
}

/// The fields that we use, from data that stand point by point (`by_point`) or field by field.
Decoded from_bytes(const PcdHeader& header, Bytes data, bool by_point) {
  const auto points = static_cast<std::size_t>(header.points);
  CloudBuilder builder(points);
  const RoleFields roles = roles_of(header);
  for (std::size_t role = 0; role < kRoles; ++role) {
    if (!roles[role]) continue;
    const PcdField& field = header.fields[*roles[role]];
    builder.add(static_cast<Role>(role), {.bytes = data,
                                          .offset = by_point ? field.offset : field.offset * points,
                                          .stride = by_point ? header.point_bytes : field.bytes(),
                                          .type = field.type});
  }
  return std::move(builder).take();
}

Expected<Decoded> read_binary(Input& input, const PcdHeader& header) {
  const std::uint64_t length = header.points * header.point_bytes;  // checked against the size before
  if (auto allowed = input.allow(header.points, length); !allowed) return Unexpected(allowed.error());
  const auto data = input.read(header.data_offset, length);
  if (!data) return Unexpected(data.error());
  return from_bytes(header, *data, true);
}

/// The two lengths before compressed data.
struct PackedSize {
  std::uint64_t packed = 0;
  std::uint64_t unpacked = 0;
};

Expected<PackedSize> read_packed_size(Input& input, const PcdHeader& header) {
  constexpr std::uint64_t kLengths = 8;
  const std::uint64_t left = input.size() - header.data_offset;
  if (left < kLengths) {
    return Unexpected(input.error_at(ErrorCode::kUnusable, header.data_offset,
                                     "compressed data end in their lengths", fmt::format("{} B", left),
                                     ">= 8 B"));
  }
  const auto lengths = input.read(header.data_offset, kLengths);
  if (!lengths) return Unexpected(lengths.error());
  const PackedSize size{load_le<std::uint32_t>(*lengths, 0), load_le<std::uint32_t>(*lengths, 4)};
  if (size.packed > left - kLengths) {
    return Unexpected(
        input.error_at(ErrorCode::kUnusable, header.data_offset, "compressed data are longer than the file",
                       fmt::format("{} B", size.packed), fmt::format("<= {} B", left - kLengths)));
  }
  // By division: POINTS is not checked yet.
  const bool fits =
      size.unpacked % header.point_bytes == 0 && size.unpacked / header.point_bytes == header.points;
  if (!fits) {
    return Unexpected(input.error_at(
        ErrorCode::kUnusable, header.data_offset + 4, "unpacked size is not POINTS x point size",
        fmt::format("{} B", size.unpacked), fmt::format("{} x {} B", header.points, header.point_bytes)));
  }
  return size;
}

Expected<Decoded> read_compressed(Input& input, const PcdHeader& header) {
  constexpr std::uint64_t kGreatestRatio = 256;
  const auto size = read_packed_size(input, header);
  if (!size) return Unexpected(size.error());
  if (size->unpacked / kGreatestRatio > size->packed) {
    return Unexpected(
        input.error_at(ErrorCode::kUnusable, header.data_offset + 4, "data cannot be compressed that much",
                       fmt::format("{} B from {} B", size->unpacked, size->packed), "ratio <= 256"));
  }
  if (auto allowed = input.allow(header.points, size->packed + size->unpacked); !allowed) {
    return Unexpected(allowed.error());
  }
  const std::uint64_t begin = header.data_offset + 8;
  const auto packed = input.read(begin, size->packed);
  if (!packed) return Unexpected(packed.error());
  Buffer buffer;
  const std::span<std::byte> data = buffer.fresh(static_cast<std::size_t>(size->unpacked));
  if (const auto fault = unpack_lzf(*packed, data)) {
    return Unexpected(input.error_at(ErrorCode::kUnusable, begin + *fault, "compressed data are damaged"));
  }
  return from_bytes(header, data, false);
}

Expected<Decoded> read_ascii(Input& input, const PcdHeader& header) {
  const std::uint64_t length = input.size() - header.data_offset;
  if (auto allowed = input.allow(header.points, length); !allowed) return Unexpected(allowed.error());
  const auto data = input.read(header.data_offset, length);
  if (!data) return Unexpected(data.error());
  const RoleFields roles = roles_of(header);
  std::vector<RowCell> cells;
  for (std::size_t i = 0; i < header.fields.size(); ++i) {
    const PcdField& field = header.fields[i];
    for (std::size_t k = 0; k < field.count; ++k) {
      cells.push_back({k == 0 ? role_of_field(roles, i) : std::nullopt, field.type});
    }
  }
  LineReader lines(as_text(*data), header.data_line);
  return read_rows(input, lines, cells, static_cast<std::size_t>(header.points));
}

}  // namespace

Expected<Decoded> read_pcd(Input& input) {
  const auto header = read_pcd_header(input);
  if (!header) return Unexpected(header.error());
  if (header->points == 0) {
    return Unexpected(error_at(input, ErrorCode::kDamaged, header->points_at, "has 0 points"));
  }
  const auto read = [&]() -> Expected<Decoded> {
    switch (header->data) {
      case PcdData::kAscii:
        return read_ascii(input, *header);
      case PcdData::kBinary:
        return read_binary(input, *header);
      case PcdData::kBinaryCompressed:
        break;
    }
    return read_compressed(input, *header);
  };
  auto out = read();
  if (out && header->has_viewpoint)
    out->notes.emplace_back("VIEWPOINT is not applied: points stay as they are stored");
  return out;
}

}  // namespace verge::io
