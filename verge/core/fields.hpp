// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace verge {

/// What a configuration value means. One entry a field stands in the `fields(visitor)` of its Config struct,
/// and the help text, the configuration file, the table in the documentation and the viewer are all made from
/// it.
///
///     struct Config {
///       double height_max_m = 0.5;
///       template <class Self, class Visitor>
///       static void fields(Self& self, Visitor&& visit) {
///         visit(self.height_max_m, {"height_max_m", "m", 0.0, 5.0, "points higher above the road are
///         dropped", "paper 3, II-1 (1); value ours"});
///       }
///     };
///
/// Field types: bool, std::int64_t, double, or an enum with `enum_names` (below).
struct FieldInfo {
  std::string_view name;     ///< Key in files and in --set, with its unit as suffix.
  std::string_view unit;     ///< "m", "rad", "1", ...
  double min = 0.0;          ///< Least value allowed (numbers only).
  double max = 0.0;          ///< Greatest value allowed (numbers only).
  std::string_view meaning;  ///< What it does and what raising it does.
  std::string_view source;   ///< Paper, table, or "ours".
};

/// The spelling of an enum's values in files and output, in the order of the values 0, 1, 2, ...
/// Specialise it beside the enum: template <> inline constexpr std::array enum_names<Reading>{"fixed",
/// "paper"};
template <class Enum>
inline constexpr std::array<std::string_view, 0> enum_names{};

}  // namespace verge
