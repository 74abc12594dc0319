// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/io/notes.hpp"

#include <cstddef>

#include <fmt/core.h>

namespace verge::io {

void Notes::once(const Log& log, const std::string& file, const std::string& text) {
  constexpr std::size_t kMost = 16;
  if (said_.size() < kMost && said_.insert(text).second) note(log, fmt::format("{}: {}", file, text));
}

void Notes::rings(const Log& log, const std::string& file, const Organised& organised) {
  if (ring_source_ != organised.source) note(log, fmt::format("{}: {}", file, organised.note));
  ring_source_ = organised.source;
}

}  // namespace verge::io
