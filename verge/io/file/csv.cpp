// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/io/file/csv.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/core.h>

#include "verge/io/file/columns.hpp"
#include "verge/io/file/rows.hpp"
#include "verge/io/text.hpp"

namespace verge::io {
namespace {

constexpr std::size_t kLongestLine = 64U << 10U;
constexpr std::size_t kMostColumns = 256;
constexpr std::string_view kUtf8Mark = "\xEF\xBB\xBF";
constexpr std::string_view kSpace = " \t";

std::string_view trim(std::string_view text) {
  const std::size_t begin = text.find_first_not_of(kSpace);
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(kSpace) - begin + 1);
}

/// What parts the cells of the first line: a semicolon or tab where it has one, since a comma may then be a
/// decimal comma.
char delimiter_of(std::string_view line) {
  for (const char c : {';', '\t'}) {
    if (line.find(c) != std::string_view::npos) return c;
  }
  return ',';
}

/// Cells of one line.
class CellReader {
 public:
  CellReader(std::string_view line, std::size_t number, char delimiter)
      : line_(line), number_(number), delimiter_(delimiter) {}

  /// The next cell without its quotes and the spaces around it; none at the end. A quote that stays open is
  /// said by open_quote().
  [[nodiscard]] std::optional<Token> next() {
    if (at_ > line_.size()) return std::nullopt;
    const std::size_t begin = std::min(line_.find_first_not_of(' ', at_), line_.size());
    if (begin < line_.size() && line_[begin] == '"') return quoted_cell(begin);
    const std::size_t end = std::min(line_.find(delimiter_, at_), line_.size());
    const Token cell{trim(line_.substr(at_, end - at_)), number_, at_ + 1};
    at_ = end + 1;
    return cell;
  }

  [[nodiscard]] std::optional<Token> open_quote() const { return open_quote_; }
  [[nodiscard]] Token end() const { return {{}, number_, line_.size() + 1}; }

 private:
  [[nodiscard]] std::optional<Token> quoted_cell(std::size_t begin) {
    const std::size_t close = line_.find('"', begin + 1);
    if (close == std::string_view::npos) {
      open_quote_ = Token{line_.substr(begin), number_, begin + 1};
      at_ = line_.size() + 1;
      return std::nullopt;
    }
    const std::size_t end = std::min(line_.find(delimiter_, close), line_.size());
    at_ = end + 1;
    const bool alone = trim(line_.substr(close + 1, end - close - 1)).empty();
    const std::string_view inside = line_.substr(begin + 1, close - begin - 1);
    return Token{alone ? trim(inside) : line_.substr(begin, end - begin), number_, begin + 1};
  }

  std::string_view line_;
  std::size_t number_;
  char delimiter_;
  std::size_t at_ = 0;
  std::optional<Token> open_quote_;
};

std::vector<Token> cells_of(CellReader& reader) {
  std::vector<Token> cells;
  while (const auto cell = reader.next()) cells.push_back(*cell);
  return cells;
}

/// A column's name without its unit: "x [m]", "x (m)" and "x_m" are x.
std::string name_without_unit(std::string_view cell) {
  std::string_view name = trim(cell.substr(0, cell.find_first_of("[(")));
  for (const std::string_view unit : {"_m", "_s", "_ns"}) {
    if (name.size() > unit.size() && name.ends_with(unit)) name.remove_suffix(unit.size());
  }
  return std::string(name);
}

bool is_header(const std::vector<Token>& cells) {
  return std::any_of(cells.begin(), cells.end(), [](const Token& cell) {
    return !cell.text.empty() && std::isalpha(static_cast<unsigned char>(cell.text.front())) != 0 &&
           !parse_number<double>(cell.text);
  });
}

bool has_position(const RoleFields& roles) {
  return roles[static_cast<std::size_t>(Role::kX)] && roles[static_cast<std::size_t>(Role::kY)] &&
         roles[static_cast<std::size_t>(Role::kZ)];
}

RoleFields header_roles(const std::vector<Token>& cells) {
  std::vector<std::string> names;
  for (const Token& cell : cells) names.push_back(name_without_unit(cell.text));
  return assign_roles(names);
}

/// Roles of a table without a header, by its number of columns.
RoleFields default_roles(std::size_t columns) {
  std::vector<std::string> names;
  if (columns == 6) names = {"number", "level", "distance", "x", "y", "z"};
  if (columns == 4) names = {"x", "y", "z", "intensity"};
  if (columns == 3) names = {"x", "y", "z"};
  return assign_roles(names);
}

/// Between 1973 and 2262.
bool is_absolute_seconds(double value) { return value > 1e8 && value < 9.2e9; }

class TableParser {
 public:
  /// At most `rows` rows will come.
  TableParser(const Input& input, std::string_view text, std::size_t rows)
      : input_(input), lines_(text), rows_(rows) {}

  [[nodiscard]] Expected<Decoded> read();

 private:
  [[nodiscard]] Error fail(const Token& at, std::string what, std::string got = {},
                           std::string need = {}) const {
    return error_at(input_, ErrorCode::kUnusable, at, std::move(what), std::move(got), std::move(need));
  }
  [[nodiscard]] Expected<std::optional<std::string_view>> next_line();
  [[nodiscard]] Expected<void> begin(std::string_view line);
  [[nodiscard]] Expected<void> add_row(std::string_view line);
  [[nodiscard]] Error bad_number(const Token& cell) const;

  const Input& input_;
  LineReader lines_;
  std::size_t rows_;
  char delimiter_ = ',';
  std::size_t columns_ = 0;
  RoleFields roles_;
  std::array<std::vector<double>, kRoles> values_;
  std::vector<std::int64_t>
      stamps_ns_;  // of rows whose time is in absolute seconds: exact, which a double is not
  std::vector<std::string> notes_;
};

/// The next line with something on it, checked for what no line may have.
Expected<std::optional<std::string_view>> TableParser::next_line() {
  while (auto line = lines_.next()) {
    if (line->size() > kLongestLine) {
      return Unexpected(fail({{}, lines_.number(), kLongestLine + 1}, "line is too long",
                             fmt::format("{} B", line->size()), fmt::format("<= {} B", kLongestLine)));
    }
    if (const std::size_t nul = line->find('\0'); nul != std::string_view::npos) {
      return Unexpected(fail({{}, lines_.number(), nul + 1}, "NUL byte in a text"));
    }
    if (!trim(*line).empty()) return line;
  }
  return std::nullopt;
}

/// The first line says what parts the cells, how many there are, and what they mean.
Expected<void> TableParser::begin(std::string_view line) {
  delimiter_ = delimiter_of(line);
  CellReader reader(line, lines_.number(), delimiter_);
  const std::vector<Token> cells = cells_of(reader);
  if (const auto quote = reader.open_quote()) return Unexpected(fail(*quote, "quote is not closed"));
  if (cells.size() > kMostColumns) {
    return Unexpected(
        fail(cells[kMostColumns], "too many columns", fmt::format("{}", cells.size()), "<= 256"));
  }
  columns_ = cells.size();
  const bool header = is_header(cells);
  roles_ = header ? header_roles(cells) : default_roles(columns_);
  if (!has_position(roles_)) {
    return Unexpected(
        fail({{}, lines_.number(), 1}, "columns x, y, z are not there", fmt::format("{} columns", columns_),
             "a header that names them, or 6 columns number, level, distance, x, y, z, or 3 or 4"));
  }
  for (std::size_t role = 0; role < kRoles; ++role) {
    if (roles_[role]) values_[role].reserve(rows_);
  }
  if (header) return {};
  notes_.push_back(fmt::format("table without header: {}", columns_ == 6 ? "number, level, distance, x, y, z"
                                                           : columns_ == 4 ? "x, y, z, intensity"
                                                                           : "x, y, z"));
  return add_row(line);
}

Error TableParser::bad_number(const Token& cell) const {
  if (cell.text.empty()) return fail(cell, "cell is empty");
  std::string pointed(cell.text);
  std::replace(pointed.begin(), pointed.end(), ',', '.');
  const bool comma = cell.text.find(',') != std::string_view::npos && parse_number<double>(pointed);
  return fail(cell, comma ? "number with a decimal comma" : "no number", quoted(cell.text),
              "a number such as 1.5");
}

Expected<void> TableParser::add_row(std::string_view line) {
  CellReader reader(line, lines_.number(), delimiter_);
  std::array<double, kMostColumns> row{};
  std::size_t columns = 0;
  while (const auto cell = reader.next()) {
    if (columns == columns_) {
      return Unexpected(
          fail(*cell, "row has more cells than the first", quoted(cell->text), fmt::format("{}", columns_)));
    }
    const auto value = parse_number<double>(cell->text);
    if (!value) return Unexpected(bad_number(*cell));
    if (columns == roles_[static_cast<std::size_t>(Role::kTime)] && is_absolute_seconds(*value)) {
      stamps_ns_.push_back(parse_seconds(cell->text).value_or(0));
    }
    row[columns++] = *value;
  }
  if (const auto quote = reader.open_quote()) return Unexpected(fail(*quote, "quote is not closed"));
  if (columns < columns_) {
    return Unexpected(fail(reader.end(), "row has fewer cells than the first", fmt::format("{}", columns),
                           fmt::format("{}", columns_)));
  }
  for (std::size_t role = 0; role < kRoles; ++role) {
    if (roles_[role]) values_[role].push_back(row[*roles_[role]]);
  }
  return {};
}

Expected<Decoded> TableParser::read() {
  auto line = next_line();
  if (line && *line) {
    if (auto begun = begin(**line); !begun) return Unexpected(begun.error());
    for (line = next_line(); line && *line; line = next_line()) {
      if (auto added = add_row(**line); !added) return Unexpected(added.error());
    }
  }
  if (!line) return Unexpected(line.error());
  const std::size_t points = values_[0].size();
  if (points == 0) {
    return Unexpected(error_at(input_, ErrorCode::kDamaged,
                               {{}, std::max<std::size_t>(lines_.number(), 1), 1}, "has 0 points"));
  }
  CloudBuilder builder(points);
  const bool exact = stamps_ns_.size() == points;
  for (std::size_t role = 0; role < kRoles; ++role) {
    if (exact && role == static_cast<std::size_t>(Role::kTime)) continue;
    if (roles_[role]) builder.add(static_cast<Role>(role), values_[role], Scalar::kF64);
  }
  if (exact) builder.add_times(stamps_ns_);
  Decoded out = std::move(builder).take();
  out.notes.insert(out.notes.end(), notes_.begin(), notes_.end());
  return out;
}

}  // namespace

Expected<Decoded> read_csv(Input& input) {
  if (auto allowed = input.allow(0, input.size()); !allowed) return Unexpected(allowed.error());
  const auto bytes = input.read(0, input.size());
  if (!bytes) return Unexpected(bytes.error());
  std::string_view text = as_text(*bytes);
  if (text.starts_with(kUtf8Mark)) text.remove_prefix(kUtf8Mark.size());
  // A row has at least 6 bytes ("0,0,0" and its end): empty lines must not ask for memory.
  const std::size_t ends = static_cast<std::size_t>(
      std::max(std::count(text.begin(), text.end(), '\n'), std::count(text.begin(), text.end(), '\r')));
  const std::size_t rows = std::min(ends, text.size() / 6) + 1;
  if (auto allowed = input.allow(rows, input.size()); !allowed) return Unexpected(allowed.error());
  return TableParser(input, text, rows).read();
}

bool looks_like_table(std::string_view head) {
  if (head.starts_with(kUtf8Mark)) head.remove_prefix(kUtf8Mark.size());
  LineReader lines(head);
  auto line = lines.next();
  while (line && trim(*line).empty()) line = lines.next();
  if (!line || line->size() > kLongestLine) return false;
  CellReader reader(*line, 1, delimiter_of(*line));
  const std::vector<Token> cells = cells_of(reader);
  if (is_header(cells)) return has_position(header_roles(cells));
  return has_position(default_roles(cells.size())) &&
         std::all_of(cells.begin(), cells.end(),
                     [](const Token& cell) { return parse_number<double>(cell.text); });
}

}  // namespace verge::io
