// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "verge/core/bytes.hpp"
#include "verge/core/error.hpp"
#include "verge/io/file/decoded.hpp"
#include "verge/io/file/ros_messages.hpp"
#include "verge/io/file/ros_wire.hpp"
#include "verge/scan/scan.hpp"

namespace verge::io {

/// sensor_msgs/PointField.
struct PointField {
  std::string name;
  std::uint32_t offset = 0;  ///< Bytes from the beginning of a point.
  std::uint8_t datatype =
      0;  ///< 1 int8, 2 uint8, 3 int16, 4 uint16, 5 int32, 6 uint32, 7 float32, 8 float64.
  std::uint32_t count = 1;
};

/// sensor_msgs/PointCloud2, checked against itself: all points and all fields lie inside `data`.
struct PointCloud2 {
  RosHeader header;
  std::uint32_t height = 0;
  std::uint32_t width = 0;
  std::vector<PointField> fields;
  bool big_endian = false;
  std::uint32_t point_step = 0;  ///< Bytes from point to point.
  std::uint32_t row_step = 0;    ///< Bytes from row to row.
  Bytes data;                    ///< Looks into the message.

  [[nodiscard]] std::uint64_t points() const { return std::uint64_t{height} * width; }
};

/// Fails with kDamaged where the message ends too early, a field lies outside its point or has no type, or
/// the points do not fit the data (reliability B2); `where` is the offset in the message.
[[nodiscard]] Expected<PointCloud2> read_point_cloud2(Wire wire, Bytes message);

/// The points by the names of the fields (columns.hpp), whatever their types, offsets and order. Times that
/// count from the header's stamp are made to count from the first point, which then gives `stamp_ns`; a stamp
/// of 0 is none. Without a ring field, the rows (or columns, whichever are fewer) of an organised cloud are
/// the rings. The caller has judged `points()`. Fails with kDamaged where there is no point, or no x, y or z.
[[nodiscard]] Expected<Decoded> decode_point_cloud2(const PointCloud2& cloud);

/// The scan as a PointCloud2 in little-endian CDR: the columns of point_table.hpp in the input's order, times
/// as nanoseconds after the stamp. Reading it gives the same scan, and the same bytes again.
[[nodiscard]] std::string write_point_cloud2(const Scan& scan);

}  // namespace verge::io
