// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "verge/io/file/columns.hpp"
#include "verge/io/input.hpp"
#include "verge/io/text.hpp"

namespace verge::io {

/// One entry of FIELDS with its SIZE, TYPE and COUNT.
struct PcdField {
  std::string name;
  Scalar type = Scalar::kF32;
  std::size_t count = 1;
  std::size_t offset = 0;  ///< Bytes from the beginning of a point.

  [[nodiscard]] std::size_t bytes() const { return count * size_of(type); }
};

enum class PcdData : std::uint8_t { kAscii, kBinary, kBinaryCompressed };

/// The header of a PCD file, checked against itself and against the size of the file (reliability B2).
struct PcdHeader {
  std::vector<PcdField> fields;
  std::size_t point_bytes = 0;  ///< Of one point in the data.
  std::uint64_t points = 0;
  Token points_at;  ///< Where POINTS (or WIDTH) stands.
  PcdData data = PcdData::kAscii;
  std::uint64_t data_offset = 0;
  std::size_t data_line = 1;   ///< Number of the first line of data.
  bool has_viewpoint = false;  ///< VIEWPOINT is another than the sensor's own.
};

/// Reads the header: entries in any order, comments anywhere, FIELDS or COLUMNS, COUNT and one of POINTS and
/// WIDTH, HEIGHT optional. Fails with kUnusable at the line and column of the first entry that makes no
/// sense.
[[nodiscard]] Expected<PcdHeader> read_pcd_header(Input& input);

}  // namespace verge::io
