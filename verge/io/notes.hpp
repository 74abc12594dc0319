// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <set>
#include <string>

#include "verge/core/log.hpp"
#include "verge/scan/organise.hpp"

namespace verge::io {

/// Says what there is to say of a recording's scans once, not at each of thousands.
class Notes {
 public:
  /// The text, unless it was said before or too much was.
  void once(const Log& log, const std::string& file, const std::string& text);
  /// Where the rings come from, when they are found another way than in the scan before.
  void rings(const Log& log, const std::string& file, const Organised& organised);

 private:
  std::set<std::string> said_;
  std::optional<RingSource> ring_source_;
};

}  // namespace verge::io
