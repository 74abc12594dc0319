// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/io/file/rows.hpp"

#include <string_view>
#include <utility>
#include <vector>

#include <fmt/core.h>

namespace verge::io {
namespace {

bool is_blank(std::string_view line) { return line.find_first_not_of(" \t") == std::string_view::npos; }

/// The next line with something on it.
std::optional<std::string_view> next_row(LineReader& lines) {
  auto line = lines.next();
  while (line && is_blank(*line)) line = lines.next();
  return line;
}

class RowParser {
 public:
  RowParser(const Input& input, std::span<const RowCell> cells, std::size_t points)
      : input_(input), cells_(cells), values_(cells.size()) {
    for (std::size_t i = 0; i < cells.size(); ++i) {
      if (cells[i].role) values_[i].reserve(points);
    }
  }

  [[nodiscard]] Expected<void> add(std::string_view line, std::size_t number) {
    WordReader words(line, number);
    for (std::size_t i = 0; i < cells_.size(); ++i) {
      const auto value = next_number(words);
      if (!value) return Unexpected(value.error());
      if (cells_[i].role) values_[i].push_back(*value);
      if (cells_[i].longest_list == 0) continue;
      if (auto skipped = skip_list(words, *value, cells_[i]); !skipped) return skipped;
    }
    if (const auto word = words.next()) {
      return Unexpected(error_at(input_, ErrorCode::kUnusable, *word, "row is too long", quoted(word->text)));
    }
    return {};
  }

  [[nodiscard]] Decoded take(std::size_t points) && {
    CloudBuilder builder(points);
    for (std::size_t i = 0; i < cells_.size(); ++i) {
      if (cells_[i].role) builder.add(*cells_[i].role, values_[i], cells_[i].type);
    }
    return std::move(builder).take();
  }

 private:
  [[nodiscard]] Expected<double> next_number(WordReader& words) const {
    const auto word = words.next();
    if (!word) return Unexpected(error_at(input_, ErrorCode::kUnusable, words.end(), "row is too short"));
    const auto value = parse_number<double>(word->text);
    if (!value)
      return Unexpected(error_at(input_, ErrorCode::kUnusable, *word, "no number", quoted(word->text)));
    return *value;
  }

  [[nodiscard]] Expected<void> skip_list(WordReader& words, double length, const RowCell& cell) const {
    const bool fits = length >= 0 && length <= static_cast<double>(cell.longest_list);  // NaN does not
    if (!fits) {
      return Unexpected(error_at(input_, ErrorCode::kUnusable, words.end(), "list is too long",
                                 fmt::format("{}", length), fmt::format("<= {}", cell.longest_list)));
    }
    for (auto left = static_cast<std::uint64_t>(length); left > 0; --left) {
      if (auto value = next_number(words); !value) return Unexpected(value.error());
    }
    return {};
  }

  const Input& input_;
  std::span<const RowCell> cells_;
  std::vector<std::vector<double>> values_;
};

}  // namespace

std::optional<Role> role_of_field(const RoleFields& roles, std::size_t index) {
  for (std::size_t role = 0; role < kRoles; ++role) {
    if (roles[role] == index) return static_cast<Role>(role);
  }
  return std::nullopt;
}

Expected<Decoded> read_rows(const Input& input, LineReader& lines, std::span<const RowCell> cells,
                            std::size_t points, bool last) {
  RowParser parser(input, cells, points);
  for (std::size_t i = 0; i < points; ++i) {
    const auto line = next_row(lines);
    if (!line) {
      const Token end{{}, lines.number(), 1};
      return Unexpected(error_at(input, ErrorCode::kUnusable, end, "data end too early",
                                 fmt::format("{} points", i), fmt::format("{}", points)));
    }
    if (auto added = parser.add(*line, lines.number()); !added) return Unexpected(added.error());
  }
  Decoded out = std::move(parser).take(points);
  if (last && next_row(lines)) {
    out.notes.push_back(fmt::format("what stands behind the last of {} points is left out (line {})", points,
                                    lines.number()));
  }
  return out;
}

Expected<void> skip_rows(const Input& input, LineReader& lines, std::string_view element,
                         std::uint64_t rows) {
  for (std::uint64_t i = 0; i < rows; ++i) {
    if (next_row(lines)) continue;
    return Unexpected(error_at(input, ErrorCode::kUnusable, {{}, lines.number(), 1},
                               fmt::format("data end inside element {}", element), fmt::format("{} rows", i),
                               fmt::format("{}", rows)));
  }
  return {};
}

}  // namespace verge::io
