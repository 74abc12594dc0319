// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <string>

namespace verge::app {

/// "[=====>    ]  52/100 scans  13.1 scans/s  ETA 0:04" for a run that took `seconds` so far. The rate and
/// the time left come with the first scan that is done. Without a total: "52 scans  13.1 scans/s".
[[nodiscard]] std::string progress_line(std::size_t done, std::optional<std::size_t> total, double seconds);

}  // namespace verge::app
