// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string_view>

namespace verge {

enum class LogLevel { kNote, kWarning };

/// Where the library says what it decided or skipped. The library itself never prints; an empty sink is
/// silence. Called from one thread at a time.
using Log = std::function<void(LogLevel, std::string_view)>;

inline void note(const Log& log, std::string_view text) {
  if (log) log(LogLevel::kNote, text);
}

inline void warn(const Log& log, std::string_view text) {
  if (log) log(LogLevel::kWarning, text);
}

}  // namespace verge
