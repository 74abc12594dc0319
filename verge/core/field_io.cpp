// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/core/field_io.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <iterator>
#include <numeric>
#include <optional>
#include <system_error>

#include <fmt/core.h>

namespace verge {
namespace {

/// Text that gives the same double again, and that a reader sees is not a whole number.
std::string number_text(double value) {
  std::string text = fmt::format("{}", value);
  if (std::isfinite(value) && text.find_first_of(".e") == std::string::npos) text += ".0";
  return text;
}

template <class Number>
std::optional<Number> number_of(std::string_view text) {
  if (text.starts_with('+')) text.remove_prefix(1);
  Number value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return value;
}

[[noreturn]] void throw_misfit(const FieldRow& row, std::string_view text) {
  const std::string unit = row.info.unit.empty() ? "" : fmt::format(" {}", row.info.unit);
  throw std::invalid_argument(
      fmt::format("{}: '{}' does not fit (need {}{})", row.info.name, text, range_of(row), unit));
}

bool in_range(double value, const FieldInfo& info) { return value >= info.min && value <= info.max; }

std::string join(std::span<const std::string_view> words, std::string_view glue) {
  std::string joined;
  for (const std::string_view word : words) {
    if (!joined.empty()) joined += glue;
    joined += word;
  }
  return joined;
}

/// Levenshtein's distance of two words, with one row of the table at a time.
std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t replaced = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
      diagonal = row[j];
      row[j] = std::min({replaced, row[j] + 1, row[j - 1] + 1});
    }
  }
  return row.back();
}

std::string details_of(const FieldRow& row) {
  const std::string unit = row.info.unit.empty() ? "" : fmt::format("unit {}; ", row.info.unit);
  return fmt::format("{}range {}; source: {}", unit, range_of(row), row.info.source);
}

/// `text` broken at blanks into lines of at most `width` bytes; a longer word stands alone.
std::vector<std::string> wrap(std::string_view text, std::size_t width) {
  std::vector<std::string> lines;
  while (!text.empty()) {
    const std::size_t blank = text.find(' ');
    const std::string_view word = text.substr(0, blank);
    if (lines.empty() || lines.back().size() + 1 + word.size() > width) {
      lines.emplace_back(word);
    } else {
      lines.back().append(" ").append(word);
    }
    text.remove_prefix(blank == std::string_view::npos ? text.size() : blank + 1);
  }
  return lines;
}

}  // namespace

namespace fields_detail {

void parse(bool& value, const FieldInfo& info, std::string_view text) {
  if (text != "true" && text != "false") throw_misfit(row(value, info), text);
  value = text == "true";
}

void parse(std::int64_t& value, const FieldInfo& info, std::string_view text) {
  const auto parsed = number_of<std::int64_t>(text);
  if (!parsed || !in_range(static_cast<double>(*parsed), info)) throw_misfit(row(value, info), text);
  value = *parsed;
}

void parse(double& value, const FieldInfo& info, std::string_view text) {
  const auto parsed = number_of<double>(text);
  if (!parsed || !in_range(*parsed, info)) throw_misfit(row(value, info), text);
  value = *parsed;
}

std::size_t parse_choice(std::span<const std::string_view> choices, const FieldInfo& info,
                         std::string_view text) {
  const auto found = std::find(choices.begin(), choices.end(), text);
  if (found == choices.end()) throw_misfit(FieldRow{info, FieldType::kChoice, choices, {}}, text);
  return static_cast<std::size_t>(std::distance(choices.begin(), found));
}

FieldRow row(bool value, const FieldInfo& info) {
  return {info, FieldType::kSwitch, {}, value ? "true" : "false"};
}

FieldRow row(std::int64_t value, const FieldInfo& info) {
  return {info, FieldType::kWhole, {}, fmt::format("{}", value)};
}

FieldRow row(double value, const FieldInfo& info) {
  return {info, FieldType::kNumber, {}, number_text(value)};
}

FieldRow row_of_choice(std::span<const std::string_view> choices, std::size_t index, const FieldInfo& info) {
  const bool known = index < choices.size();
  return {info, FieldType::kChoice, choices, known ? std::string(choices[index]) : fmt::format("{}", index)};
}

void check_range(const FieldRow& row) {
  if (row.type == FieldType::kSwitch) return;
  if (row.type == FieldType::kChoice) {
    const bool known = std::find(row.choices.begin(), row.choices.end(), row.value) != row.choices.end();
    if (!known) throw_misfit(row, row.value);
    return;
  }
  const auto value = number_of<double>(row.value);
  if (!value || !in_range(*value, row.info)) throw_misfit(row, row.value);
}

void throw_unknown_key(std::string_view key, std::span<const FieldRow> rows) {
  std::vector<std::string_view> names;
  for (const FieldRow& row : rows) names.push_back(row.info.name);
  const std::string_view near = nearest_word(key, names);
  const std::string advice =
      near.empty() ? fmt::format("known: {}", join(names, ", ")) : fmt::format("did you mean '{}'?", near);
  throw std::invalid_argument(fmt::format("unknown key '{}' ({})", key, advice));
}

}  // namespace fields_detail

std::string range_of(const FieldRow& row) {
  switch (row.type) {
    case FieldType::kSwitch:
      return "true or false";
    case FieldType::kChoice:
      return join(row.choices, " or ");
    case FieldType::kWhole:
    case FieldType::kNumber:
      break;
  }
  return fmt::format("{} to {}", row.info.min, row.info.max);
}

std::string to_toml(std::string_view section, std::span<const FieldRow> rows) {
  constexpr std::size_t kCommentWidth = 98;
  std::string text = fmt::format("[{}]\n", section);
  for (const FieldRow& row : rows) {
    for (const std::string& line : wrap(row.info.meaning, kCommentWidth)) text += fmt::format("# {}\n", line);
    for (const std::string& line : wrap(details_of(row), kCommentWidth)) text += fmt::format("# {}\n", line);
    const std::string_view quote = row.type == FieldType::kChoice ? "\"" : "";
    text += fmt::format("{} = {}{}{}\n\n", row.info.name, quote, row.value, quote);
  }
  return text;
}

std::string plain_dump(std::string_view section, std::span<const FieldRow> rows) {
  std::string text;
  for (const FieldRow& row : rows) text += fmt::format("{}.{} = {}\n", section, row.info.name, row.value);
  return text;
}

std::string to_table(std::span<const FieldRow> rows) {
  std::size_t key = 3;
  std::size_t value = 7;
  std::size_t unit = 4;
  std::size_t range = 5;
  for (const FieldRow& row : rows) {
    key = std::max(key, row.info.name.size());
    value = std::max(value, row.value.size());
    unit = std::max(unit, row.info.unit.size());
    range = std::max(range, range_of(row).size());
  }
  std::string text = fmt::format("{:{}}  {:{}}  {:{}}  {:{}}  meaning [source]\n", "key", key, "default",
                                 value, "unit", unit, "range", range);
  for (const FieldRow& row : rows) {
    text += fmt::format("{:{}}  {:{}}  {:{}}  {:{}}  {} [{}]\n", row.info.name, key, row.value, value,
                        row.info.unit, unit, range_of(row), range, row.info.meaning, row.info.source);
  }
  return text;
}

std::string_view nearest_word(std::string_view word, std::span<const std::string_view> words) {
  std::string_view nearest;
  // Farther than this it is another word, not a slip of the finger.
  std::size_t best = std::max<std::size_t>(2, word.size() / 3) + 1;
  for (const std::string_view candidate : words) {
    const std::size_t distance = edit_distance(word, candidate);
    if (distance >= best) continue;
    best = distance;
    nearest = candidate;
  }
  return nearest;
}

}  // namespace verge
