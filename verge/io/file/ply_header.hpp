// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "verge/io/file/columns.hpp"
#include "verge/io/input.hpp"
#include "verge/io/text.hpp"

namespace verge::io {

/// Most numbers in a list property.
inline constexpr std::uint64_t kLongestPlyList = 4096;

/// A comment that begins so says when the scan began, in nanoseconds since the Unix epoch: ours.
inline constexpr std::string_view kPlyStamp = "stamp_ns ";

struct PlyProperty {
  std::string name;
  Scalar type = Scalar::kF32;        ///< Of the value, or of the list's items.
  std::optional<Scalar> list_count;  ///< Type of the list's length, if it is a list.
};

struct PlyElement {
  std::string name;
  std::uint64_t count = 0;
  Token count_at;  ///< Where the count stands in the header.
  std::vector<PlyProperty> properties;

  [[nodiscard]] bool has_lists() const;
  /// Least bytes of one item in binary data: all of them where there are no lists.
  [[nodiscard]] std::uint64_t least_bytes() const;
};

enum class PlyData : std::uint8_t { kAscii, kLittleEndian, kBigEndian };

struct PlyHeader {
  PlyData data = PlyData::kAscii;
  std::vector<PlyElement> elements;
  std::optional<std::int64_t> stamp_ns;  ///< Of a comment "stamp_ns N".
  std::size_t vertex = 0;                ///< Index of the element vertex.
  std::uint64_t data_offset = 0;
  std::size_t data_line = 1;
};

/// Reads the header (at most 64 KiB and 1024 lines) up to end_header. Fails with kUnusable at the line and
/// column of what makes no sense.
[[nodiscard]] Expected<PlyHeader> read_ply_header(Input& input);

}  // namespace verge::io
