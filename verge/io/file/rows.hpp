// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "verge/io/file/columns.hpp"
#include "verge/io/input.hpp"
#include "verge/io/text.hpp"

namespace verge::io {

/// One number of a row of text: what it means (nothing: it is checked and left out) and its declared type;
/// or, with a `longest_list`, a list: its length and that many numbers, left out.
struct RowCell {
  std::optional<Role> role;
  Scalar type = Scalar::kF64;
  std::uint64_t longest_list = 0;
};

/// The role that field `index` has, if any.
[[nodiscard]] std::optional<Role> role_of_field(const RoleFields& roles, std::size_t index);

/// `points` rows of numbers parted by spaces or tabs, one a line, blank lines skipped; a row has one number a
/// cell. Rows behind the last are left, and noted where these rows are the `last` of the file. Fails with
/// kUnusable at the line and column of what is no number, missing or too much.
[[nodiscard]] Expected<Decoded> read_rows(const Input& input, LineReader& lines,
                                          std::span<const RowCell> cells, std::size_t points,
                                          bool last = true);

/// Steps over `rows` rows, which are items of `element`, without a look at them. Fails with kUnusable where
/// the text ends before.
[[nodiscard]] Expected<void> skip_rows(const Input& input, LineReader& lines, std::string_view element,
                                       std::uint64_t rows);

}  // namespace verge::io
