// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "apps/verge/toml_file.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <iterator>
#include <tuple>

#include <fmt/core.h>
#include <toml++/toml.h>

namespace verge::app {
namespace {

constexpr std::size_t kLongestFile = 1U << 20U;

std::string place(const toml::source_region& region) {
  return fmt::format("{}:{}", region.begin.line, region.begin.column);
}

Error usage_error(const std::filesystem::path& file, std::string where, std::string what) {
  return {ErrorCode::kUsage, file.string(), std::move(where), std::move(what), {}, {}};
}

Expected<std::string> text_of(const std::filesystem::path& file) {
  std::error_code ignored;
  if (std::filesystem::is_directory(file, ignored)) {
    return Unexpected(usage_error(file, {}, "cannot read settings: it is a folder"));
  }
  std::ifstream in(file, std::ios::binary);
  if (!in)
    return Unexpected(usage_error(file, {}, fmt::format("cannot read settings: {}", std::strerror(errno))));
  std::string text(kLongestFile + 1, '\0');
  in.read(text.data(), static_cast<std::streamsize>(text.size()));
  text.resize(static_cast<std::size_t>(in.gcount()));
  if (text.size() <= kLongestFile) return text;
  Error error = usage_error(file, {}, "settings file is too long");
  error.need = fmt::format("<= {} B", kLongestFile);
  return Unexpected(std::move(error));
}

TomlEntry entry_of(std::string_view section, const toml::key& key, const toml::node& value) {
  TomlEntry entry{std::string(section), std::string(key.str()), {},
                  TomlKind::kOther,     place(key.source()),    place(value.source())};
  if (const auto* text = value.as_string()) {
    entry.kind = TomlKind::kText;
    entry.value = text->get();
  } else if (const auto* whole = value.as_integer()) {
    entry.kind = TomlKind::kWhole;
    entry.value = fmt::format("{}", whole->get());
  } else if (const auto* number = value.as_floating_point()) {
    entry.kind = TomlKind::kNumber;
    entry.value = fmt::format("{}", number->get());
  } else if (const auto* flag = value.as_boolean()) {
    entry.kind = TomlKind::kSwitch;
    entry.value = flag->get() ? "true" : "false";
  }
  return entry;
}

/// toml++ keeps keys by name; people read errors from the top.
void sort_as_written(std::vector<TomlEntry>& entries, const std::vector<toml::source_position>& begins) {
  std::vector<std::size_t> order(entries.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return std::tuple(begins[a].line, begins[a].column, a) < std::tuple(begins[b].line, begins[b].column, b);
  });
  std::vector<TomlEntry> sorted;
  for (const std::size_t i : order) sorted.push_back(std::move(entries[i]));
  entries = std::move(sorted);
}

/// Collects the keys of a file, those of its tables, and, with `lists`, of its lists of tables.
class Collector {
 public:
  explicit Collector(bool lists) : lists_(lists) {}

  [[nodiscard]] std::vector<TomlEntry> entries_of(const toml::table& root) {
    for (const auto& [name, value] : root) {
      const toml::table* section = value.as_table();
      const toml::array* list = list_of_tables(value);
      if (list != nullptr) {
        add_list(std::string(name.str()), *list);
      } else if (section == nullptr) {
        add({}, name, value);
      } else {
        add(name.str(), toml::key(std::string_view(), name.source()), value);
        add_keys(std::string(name.str()), *section);
      }
    }
    sort_as_written(entries_, begins_);
    return std::move(entries_);
  }

 private:
  [[nodiscard]] const toml::array* list_of_tables(const toml::node& value) const {
    const toml::array* list = lists_ ? value.as_array() : nullptr;
    return list != nullptr && list->is_array_of_tables() ? list : nullptr;
  }

  void add(std::string_view section, const toml::key& key, const toml::node& value) {
    entries_.push_back(entry_of(section, key, value));
    begins_.push_back(key.source().begin);
  }

  void add_keys(const std::string& section, const toml::table& table) {
    for (const auto& [key, item] : table) {
      if (const toml::array* list = list_of_tables(item)) {
        add_list(section + "." + std::string(key.str()), *list);
      } else {
        add(section, key, item);
      }
    }
  }

  void add_list(const std::string& section, const toml::array& list) {
    for (const toml::node& element : list) {
      add(section, toml::key(std::string_view(), element.source()), element);
      add_keys(section, *element.as_table());
    }
  }

  bool lists_;
  std::vector<TomlEntry> entries_;
  std::vector<toml::source_position> begins_;
};

std::string_view name_of(TomlKind kind) {
  constexpr std::array<std::string_view, 5> kNames{"text", "a whole number", "a number", "true or false",
                                                   "a list, table or date"};
  return kNames.at(static_cast<std::size_t>(kind));
}

/// Whether a TOML value of this kind may stand for the field.
bool fits(TomlKind kind, FieldType type) {
  switch (type) {
    case FieldType::kSwitch:
      return kind == TomlKind::kSwitch;
    case FieldType::kWhole:
      return kind == TomlKind::kWhole;
    case FieldType::kNumber:
      return kind == TomlKind::kWhole || kind == TomlKind::kNumber;
    case FieldType::kChoice:
      return kind == TomlKind::kText;
  }
  return false;
}

Expected<std::vector<TomlEntry>> read(const std::filesystem::path& file, bool lists) {
  const auto text = text_of(file);
  if (!text) return Unexpected(text.error());
  try {
    return Collector(lists).entries_of(toml::parse(*text, file.string()));
  } catch (const toml::parse_error& error) {
    return Unexpected(usage_error(file, place(error.source()), std::string(error.description())));
  }
}

}  // namespace

Expected<std::vector<TomlEntry>> read_toml(const std::filesystem::path& file) { return read(file, false); }

Expected<std::vector<TomlEntry>> read_toml_lists(const std::filesystem::path& file) {
  return read(file, true);
}

std::optional<std::string> kind_misfit(const TomlEntry& entry, const FieldRow& row) {
  if (fits(entry.kind, row.type)) return std::nullopt;
  return fmt::format("{}: {} does not fit (need {})", entry.key, name_of(entry.kind), range_of(row));
}

}  // namespace verge::app
