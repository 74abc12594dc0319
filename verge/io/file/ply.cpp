// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/io/file/ply.hpp"

#include <array>
#include <string>
#include <utility>
#include <vector>

#include <fmt/core.h>

#include "verge/io/file/columns.hpp"
#include "verge/io/file/ply_header.hpp"
#include "verge/io/file/rows.hpp"
#include "verge/io/text.hpp"

namespace verge::io {
namespace {

/// Roles of the element's properties. A list has none.
RoleFields roles_of(const PlyElement& element) {
  std::vector<std::string> names;
  for (const PlyProperty& property : element.properties)
    names.push_back(property.list_count ? "" : property.name);
  return assign_roles(names);
}

/// Binary data: elements one after the other.
class BinaryReader {
 public:
  BinaryReader(Input& input, const PlyHeader& header)
      : input_(input),
        header_(header),
        big_endian_(header.data == PlyData::kBigEndian),
        at_(header.data_offset) {}

  [[nodiscard]] Expected<Decoded> read();

 private:
  [[nodiscard]] Error cut(const PlyElement& element) const;
  [[nodiscard]] Expected<void> skip(const PlyElement& element);
  [[nodiscard]] Expected<Decoded> read_fixed(const PlyElement& vertex);
  [[nodiscard]] Expected<Decoded> read_ragged(const PlyElement& vertex);
  /// Reads what is left from at_ on, for items whose size only they know.
  [[nodiscard]] Expected<Bytes> rest();
  /// Bytes of the item that begins at `at` in `bytes`; where each property's value begins goes to `offsets`.
  [[nodiscard]] Expected<std::size_t> item_bytes(const PlyElement& element, Bytes bytes, std::size_t at,
                                                 std::vector<std::size_t>& offsets) const;

  Input& input_;
  const PlyHeader& header_;
  bool big_endian_;
  std::uint64_t at_;
};

Error BinaryReader::cut(const PlyElement& element) const {
  return error_at(input_, ErrorCode::kUnusable, element.count_at,
                  fmt::format("element {} asks for more data than the file holds", element.name),
                  fmt::format("{} x {} B", element.count, element.least_bytes()),
                  fmt::format("<= {} B", input_.size() - at_));
}

Expected<Bytes> BinaryReader::rest() {
  const std::uint64_t left = input_.size() - at_;
  if (auto allowed = input_.allow(0, left); !allowed) return Unexpected(allowed.error());
  return input_.read(at_, left);
}

/// The length of a list at `at`; -1 and the like become far too long.
std::uint64_t list_length(Bytes bytes, std::size_t at, Scalar type, bool big_endian) {
  const auto load = [&](auto zero) {
    using T = decltype(zero);
    return static_cast<std::uint64_t>(big_endian ? load_be<T>(bytes, at) : load_le<T>(bytes, at));
  };
  switch (size_of(type)) {
    case 1:
      return type == Scalar::kI8 ? load(std::int8_t{}) : load(std::uint8_t{});
    case 2:
      return type == Scalar::kI16 ? load(std::int16_t{}) : load(std::uint16_t{});
    default:
      return type == Scalar::kI32 ? load(std::int32_t{}) : load(std::uint32_t{});
  }
}

Expected<std::size_t> BinaryReader::item_bytes(const PlyElement& element, Bytes bytes, std::size_t at,
                                               std::vector<std::size_t>& offsets) const {
  const std::size_t begin = at;
  offsets.clear();
  for (const PlyProperty& property : element.properties) {
    offsets.push_back(at);
    const std::size_t left = bytes.size() - at;
    std::uint64_t need = size_of(property.list_count.value_or(property.type));
    if (need <= left && property.list_count) {
      const std::uint64_t length = list_length(bytes, at, *property.list_count, big_endian_);
      if (length > kLongestPlyList) {
        return Unexpected(input_.error_at(ErrorCode::kUnusable, at_ + at, "list is too long",
                                          fmt::format("{}", length), fmt::format("<= {}", kLongestPlyList)));
      }
      need += length * size_of(property.type);
    }
    if (need > left) {
      return Unexpected(input_.error_at(ErrorCode::kUnusable, at_ + bytes.size(),
                                        fmt::format("data end inside element {}", element.name),
                                        fmt::format("{} B", left), fmt::format("{} B", need)));
    }
    at += static_cast<std::size_t>(need);
  }
  return at - begin;
}

Expected<void> BinaryReader::skip(const PlyElement& element) {
  const std::uint64_t least = element.least_bytes();
  if (element.count == 0 || least == 0) return {};
  if (element.count > (input_.size() - at_) / least) return Unexpected(cut(element));
  if (!element.has_lists()) {
    at_ += element.count * least;
    return {};
  }
  const auto bytes = rest();
  if (!bytes) return Unexpected(bytes.error());
  std::vector<std::size_t> offsets;
  std::size_t at = 0;
  for (std::uint64_t i = 0; i < element.count; ++i) {
    const auto item = item_bytes(element, *bytes, at, offsets);
    if (!item) return Unexpected(item.error());
    at += *item;
  }
  at_ += at;
  return {};
}

Expected<Decoded> BinaryReader::read_fixed(const PlyElement& vertex) {
  const auto stride = static_cast<std::size_t>(vertex.least_bytes());
  const auto bytes = input_.read(at_, vertex.count * stride);
  if (!bytes) return Unexpected(bytes.error());
  CloudBuilder builder(static_cast<std::size_t>(vertex.count));
  const RoleFields roles = roles_of(vertex);
  std::size_t offset = 0;
  for (std::size_t i = 0; i < vertex.properties.size(); ++i) {
    const Scalar type = vertex.properties[i].type;
    if (const auto role = role_of_field(roles, i)) {
      builder.add(
          *role,
          {.bytes = *bytes, .offset = offset, .stride = stride, .type = type, .big_endian = big_endian_});
    }
    offset += size_of(type);
  }
  return std::move(builder).take();
}

/// Vertices with lists among their properties: the values that we use, side by side, then as fixed ones.
Expected<Decoded> BinaryReader::read_ragged(const PlyElement& vertex) {
  const auto bytes = rest();
  if (!bytes) return Unexpected(bytes.error());
  const RoleFields roles = roles_of(vertex);
  std::array<std::vector<std::byte>, kRoles> values;
  std::vector<std::size_t> offsets;
  std::size_t at = 0;
  for (std::uint64_t i = 0; i < vertex.count; ++i) {
    const auto item = item_bytes(vertex, *bytes, at, offsets);
    if (!item) return Unexpected(item.error());
    for (std::size_t role = 0; role < kRoles; ++role) {
      if (!roles[role]) continue;
      const Bytes value =
          bytes->subspan(offsets[*roles[role]], size_of(vertex.properties[*roles[role]].type));
      values[role].insert(values[role].end(), value.begin(), value.end());
    }
    at += *item;
  }
  CloudBuilder builder(static_cast<std::size_t>(vertex.count));
  for (std::size_t role = 0; role < kRoles; ++role) {
    if (!roles[role]) continue;
    const Scalar type = vertex.properties[*roles[role]].type;
    builder.add(static_cast<Role>(role),
                {.bytes = values[role], .stride = size_of(type), .type = type, .big_endian = big_endian_});
  }
  return std::move(builder).take();
}

Expected<Decoded> BinaryReader::read() {
  for (std::size_t i = 0; i < header_.vertex; ++i) {
    if (auto skipped = skip(header_.elements[i]); !skipped) return Unexpected(skipped.error());
  }
  const PlyElement& vertex = header_.elements[header_.vertex];
  if (vertex.count > (input_.size() - at_) / vertex.least_bytes()) return Unexpected(cut(vertex));
  const std::uint64_t length = vertex.has_lists() ? input_.size() - at_ : vertex.count * vertex.least_bytes();
  if (auto allowed = input_.allow(vertex.count, length); !allowed) return Unexpected(allowed.error());
  return vertex.has_lists() ? read_ragged(vertex) : read_fixed(vertex);
}

/// Ascii data: an item a line. Lines of elements before vertex are stepped over unread.
Expected<Decoded> read_ascii(Input& input, const PlyHeader& header) {
  const PlyElement& vertex = header.elements[header.vertex];
  const std::uint64_t length = input.size() - header.data_offset;
  // Two bytes a number, the last of which may have no separator.
  const std::uint64_t most = (length + 1) / (2 * vertex.properties.size());
  if (vertex.count > most) {
    return Unexpected(error_at(input, ErrorCode::kUnusable, vertex.count_at,
                               "element vertex asks for more data than the file holds",
                               fmt::format("{}", vertex.count), fmt::format("<= {}", most)));
  }
  if (auto allowed = input.allow(vertex.count, length); !allowed) return Unexpected(allowed.error());
  const auto bytes = input.read(header.data_offset, length);
  if (!bytes) return Unexpected(bytes.error());
  LineReader lines(as_text(*bytes), header.data_line);
  for (std::size_t i = 0; i < header.vertex; ++i) {
    const PlyElement& element = header.elements[i];
    if (auto skipped = skip_rows(input, lines, element.name, element.count); !skipped)
      return Unexpected(skipped.error());
  }
  const RoleFields roles = roles_of(vertex);
  std::vector<RowCell> cells;
  for (std::size_t i = 0; i < vertex.properties.size(); ++i) {
    const PlyProperty& property = vertex.properties[i];
    cells.push_back({role_of_field(roles, i), property.type, property.list_count ? kLongestPlyList : 0});
  }
  const bool last = header.vertex + 1 == header.elements.size();
  return read_rows(input, lines, cells, static_cast<std::size_t>(vertex.count), last);
}

}  // namespace

Expected<Decoded> read_ply(Input& input) {
  const auto header = read_ply_header(input);
  if (!header) return Unexpected(header.error());
  const PlyElement& vertex = header->elements[header->vertex];
  if (vertex.count == 0)
    return Unexpected(error_at(input, ErrorCode::kDamaged, vertex.count_at, "has 0 points"));
  auto out =
      header->data == PlyData::kAscii ? read_ascii(input, *header) : BinaryReader(input, *header).read();
  if (out && header->stamp_ns) out->stamp_ns = header->stamp_ns;
  return out;
}

}  // namespace verge::io
