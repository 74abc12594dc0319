// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <utility>
#include <vector>

#include "verge/core/error.hpp"
#include "verge/io/input.hpp"
#include "verge/io/text.hpp"

namespace verge::io {

/// One value a line, by `parse` (std::optional<T> of a line). Blank lines do not count. Fails as Input does,
/// and with kUnusable at the line that has no value.
template <class T, class Parse>
[[nodiscard]] Expected<std::vector<T>> read_lines(const std::filesystem::path& path,
                                                  const InputLimits& limits, Parse parse) {
  auto input = Input::open(path, limits);
  if (!input) return Unexpected(input.error());
  if (auto allowed = input->allow(0, input->size()); !allowed) return Unexpected(allowed.error());
  const auto bytes = input->read(0, input->size());
  if (!bytes) return Unexpected(bytes.error());
  LineReader lines(as_text(*bytes));
  std::vector<T> values;
  while (const auto line = lines.next()) {
    if (line->find_first_not_of(" \t") == std::string_view::npos) continue;
    auto value = parse(*line);
    if (!value) {
      return Unexpected(error_at(*input, ErrorCode::kUnusable, {{}, lines.number(), 1}, "line cannot be used",
                                 quoted(*line)));
    }
    values.push_back(std::move(*value));
  }
  return values;
}

}  // namespace verge::io
