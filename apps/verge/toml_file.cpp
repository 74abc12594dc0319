// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "apps/verge/toml_file.hpp"

#include <algorithm>
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

std::vector<TomlEntry> entries_of(const toml::table& root) {
  std::vector<TomlEntry> entries;
  std::vector<toml::source_position> begins;
  const auto add = [&](std::string_view section, const toml::key& key, const toml::node& value) {
    entries.push_back(entry_of(section, key, value));
    begins.push_back(key.source().begin);
  };
  for (const auto& [name, value] : root) {
    const toml::table* section = value.as_table();
    if (section == nullptr) {
      add({}, name, value);
      continue;
    }
    add(name.str(), toml::key(std::string_view(), name.source()), value);
    for (const auto& [key, item] : *section) add(name.str(), key, item);
  }
  sort_as_written(entries, begins);
  return entries;
}

}  // namespace

Expected<std::vector<TomlEntry>> read_toml(const std::filesystem::path& file) {
  const auto text = text_of(file);
  if (!text) return Unexpected(text.error());
  try {
    return entries_of(toml::parse(*text, file.string()));
  } catch (const toml::parse_error& error) {
    return Unexpected(usage_error(file, place(error.source()), std::string(error.description())));
  }
}

}  // namespace verge::app
