// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "verge/core/fields.hpp"

namespace verge {

/// What a field's text must look like.
enum class FieldType : std::uint8_t { kSwitch, kWhole, kNumber, kChoice };

/// One field of a Config struct as text: what help, configuration files and tables are made from.
struct FieldRow {
  FieldInfo info;
  FieldType type = FieldType::kNumber;
  std::span<const std::string_view> choices;  ///< The spellings of a kChoice; else empty.
  std::string value;                          ///< Reads back to exactly the same value.
};

/// A field's key and the text for it, as in --set gradient.height_max_m=0.4 (the key without its section).
struct Setting {
  std::string key;
  std::string value;
};

namespace fields_detail {

void parse(bool& value, const FieldInfo& info, std::string_view text);
void parse(std::int64_t& value, const FieldInfo& info, std::string_view text);
void parse(double& value, const FieldInfo& info, std::string_view text);
[[nodiscard]] std::size_t parse_choice(std::span<const std::string_view> choices, const FieldInfo& info,
                                       std::string_view text);

[[nodiscard]] FieldRow row(bool value, const FieldInfo& info);
[[nodiscard]] FieldRow row(std::int64_t value, const FieldInfo& info);
[[nodiscard]] FieldRow row(double value, const FieldInfo& info);
[[nodiscard]] FieldRow row_of_choice(std::span<const std::string_view> choices, std::size_t index,
                                     const FieldInfo& info);

void check_range(const FieldRow& row);
[[noreturn]] void throw_unknown_key(std::string_view key, std::span<const FieldRow> rows);

}  // namespace fields_detail

/// The fields of `config` in their order, with its values as text.
template <class Config>
[[nodiscard]] std::vector<FieldRow> field_rows(const Config& config) {
  std::vector<FieldRow> rows;
  Config::fields(config, [&rows]<class Field>(const Field& field, const FieldInfo& info) {
    if constexpr (std::is_enum_v<Field>) {
      rows.push_back(fields_detail::row_of_choice(enum_names<Field>, static_cast<std::size_t>(field), info));
    } else {
      rows.push_back(fields_detail::row(field, info));
    }
  });
  return rows;
}

/// Sets one field from text. Throws std::invalid_argument that names the key and the allowed range where the
/// text does not fit, and the nearest known key where there is no such key; `config` is then unchanged.
template <class Config>
void set_field(Config& config, std::string_view key, std::string_view text) {
  bool found = false;
  Config::fields(config, [&]<class Field>(Field& field, const FieldInfo& info) {
    if (info.name != key) return;
    found = true;
    if constexpr (std::is_enum_v<Field>) {
      field = static_cast<Field>(fields_detail::parse_choice(enum_names<Field>, info, text));
    } else {
      fields_detail::parse(field, info, text);
    }
  });
  if (!found) fields_detail::throw_unknown_key(key, field_rows(config));
}

/// The defaults of Config with `settings` set on them, in order. Throws as set_field().
template <class Config>
[[nodiscard]] Config config_of(std::span<const Setting> settings) {
  Config config;
  for (const Setting& setting : settings) set_field(config, setting.key, setting.value);
  return config;
}

/// Throws std::invalid_argument that names the key and its range where a value of `config` is outside it.
template <class Config>
void check_fields(const Config& config) {
  for (const FieldRow& row : field_rows(config)) fields_detail::check_range(row);
}

/// What may stand for the field: "0.05 to 5", "true or false", "fixed or paper".
[[nodiscard]] std::string range_of(const FieldRow& row);

/// The rows as a section of a TOML file, with meaning, unit, range and source as comments. Read back it gives
/// the same values.
[[nodiscard]] std::string to_toml(std::string_view section, std::span<const FieldRow> rows);

/// "section.key = value" line by line and nothing else: what config_hash is made from, so that rewording a
/// comment does not change it.
[[nodiscard]] std::string plain_dump(std::string_view section, std::span<const FieldRow> rows);

/// The rows as an aligned table of plain text: key, value, unit, range, meaning and source.
[[nodiscard]] std::string to_table(std::span<const FieldRow> rows);

/// The one of `words` that `word` is most likely a misspelling of (least edit distance, the first of equals);
/// empty where none is near.
[[nodiscard]] std::string_view nearest_word(std::string_view word, std::span<const std::string_view> words);

}  // namespace verge
