// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/eval/files_below.hpp"

#include <algorithm>

#include <fmt/format.h>

namespace verge::eval {
namespace fs = std::filesystem;

Error cannot_open(const fs::path& path, const std::error_code& error) {
  return {ErrorCode::kCannotOpen, path.string(), {}, fmt::format("cannot open: {}", error.message()), {}, {}};
}

Expected<std::vector<fs::path>> files_below(const fs::path& folder) {
  std::vector<fs::path> files;
  std::error_code error;
  for (fs::recursive_directory_iterator entry(folder, error), end; !error && entry != end;
       entry.increment(error)) {
    std::error_code ignored;
    if (entry->is_regular_file(ignored)) files.push_back(entry->path());
  }
  if (error) return Unexpected(cannot_open(folder, error));
  std::sort(files.begin(), files.end());
  return files;
}

}  // namespace verge::eval
