// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string_view>
#include <vector>

#include "verge/io/source.hpp"

namespace verge::io {

/// What there is to know of a format before a byte is read.
struct FormatFacts {
  std::string_view suffix;          ///< Of the names of its files, in lower case.
  std::string_view other_suffix{};  ///< Another one that is usual; empty: none.
  bool many_scans = false;          ///< One file holds many scans.
  bool written = false;             ///< Scans can be written so.
};

[[nodiscard]] const FormatFacts& facts_of(Format format);

[[nodiscard]] std::string_view name_of(Format format);

/// All formats, in the order of the enum.
[[nodiscard]] std::vector<Format> all_formats();

/// The format whose suffix the name has; none where no format has it.
[[nodiscard]] std::optional<Format> format_of_name(const std::filesystem::path& path);

}  // namespace verge::io
