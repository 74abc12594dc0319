// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

#include "verge/core/vec.hpp"
#include "verge/io/input.hpp"

namespace verge::io {

/// "Generating software" of the files that we write: their user data are rings.
inline constexpr std::string_view kLasSoftware = "verge";

/// What the header of a LAS file says of its points (ASPRS LAS 1.4-R15, tables 3 and 5 to 17).
struct LasHeader {
  int minor_version = 4;
  std::uint8_t point_format = 6;
  std::uint16_t record_bytes = 30;
  std::uint64_t points = 0;
  std::uint64_t points_offset = 0;
  Vec3 scale{0.001, 0.001, 0.001};  ///< Metres a step.
  Vec3 offset{};
  bool gps_time_is_absolute = false;  ///< Adjusted standard GPS time; else seconds of the GPS week.
  std::string software;               ///< That made the file.
  std::string note;                   ///< What was odd and does no harm; empty where nothing was.
};

/// Bytes that a record of this point format has at least; formats 0 to 10.
[[nodiscard]] std::uint16_t las_record_bytes(std::uint8_t point_format);

/// Whether records of this format are those of LAS 1.4 (6 to 10).
[[nodiscard]] constexpr bool is_las14_format(std::uint8_t point_format) { return point_format >= 6; }
/// Whether records of this format have colours.
[[nodiscard]] constexpr bool has_colours(std::uint8_t point_format) {
  return point_format == 2 || point_format == 3 || point_format == 5 || point_format == 7 ||
         point_format == 8 || point_format == 10;
}
/// Whether records of this format have a GPS time.
[[nodiscard]] constexpr bool has_gps_time(std::uint8_t point_format) {
  return point_format == 1 || (point_format >= 3 && point_format <= 10);
}

/// Header and variable length records, checked against the file: nothing that they promise lies outside of
/// it. Fails with kUnusable at the offset of the field that is wrong, and with kDamaged where there are 0
/// points.
[[nodiscard]] Expected<LasHeader> read_las_header(Input& input);

}  // namespace verge::io
