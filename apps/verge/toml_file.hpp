// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "verge/core/error.hpp"
#include "verge/core/field_io.hpp"

namespace verge::app {

/// Kind of a TOML value.
enum class TomlKind : std::uint8_t { kText, kWhole, kNumber, kSwitch, kOther };

/// One key of a TOML file with its value as text, and where they stand ("LINE:COL").
struct TomlEntry {
  std::string section;  ///< Empty for a key above the first section.
  std::string key;      ///< Empty for the section's own name, which stands before its keys.
  std::string value;
  TomlKind kind = TomlKind::kOther;
  std::string key_where;
  std::string value_where;
};

/// The keys of a TOML file that has sections of plain values and nothing deeper, in the order in which they
/// stand. Fails with kUsage and the place: cannot be read, longer than 1 MiB, not TOML.
[[nodiscard]] Expected<std::vector<TomlEntry>> read_toml(const std::filesystem::path& file);

/// Likewise of a file whose sections may also be lists of tables ([[road]]), and those in tables of a list
/// ([[road.piece]]): the section of their keys is "road" and "road.piece", and each table of a list begins
/// with its name alone.
[[nodiscard]] Expected<std::vector<TomlEntry>> read_toml_lists(const std::filesystem::path& file);

/// What is wrong where the value's kind cannot stand for the field, which has its key; none if it can.
[[nodiscard]] std::optional<std::string> kind_misfit(const TomlEntry& entry, const FieldRow& row);

}  // namespace verge::app
