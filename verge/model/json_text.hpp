// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>

namespace verge::model {

/// Why a text is not JSON, and the column (in bytes, from 1) of the last byte read.
struct SyntaxFault {
  std::size_t column = 1;
  std::string what;
};

/// None where the text is one JSON value whose numbers all fit a double.
[[nodiscard]] std::optional<SyntaxFault> find_syntax_fault(std::string_view text);

/// A step into a JSON value: a member's name or an element's number.
using JsonStep = std::variant<std::string_view, std::size_t>;

/// The column (in bytes, from 1) at which the value at the end of `path` begins. `text` must be JSON and the
/// path must exist in it; of members of one name the last is meant, as in the parsed value.
[[nodiscard]] std::size_t column_of(std::string_view text, std::span<const JsonStep> path);

/// Where a column of `text` stands, "LINE:COLUMN" in the line that it falls into; its first line is number
/// `first_line`.
[[nodiscard]] std::string line_and_column(std::string_view text, std::size_t column, std::size_t first_line);

/// `text` with every sequence of bytes that is not UTF-8 replaced by U+FFFD.
[[nodiscard]] std::string valid_utf8(std::string_view text);

}  // namespace verge::model
