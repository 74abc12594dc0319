// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <span>

namespace verge::eval {

/// How long scans took, seconds; none without a scan.
struct RunTime {
  std::size_t scans = 0;
  std::optional<double> median_s;
  std::optional<double> percentile_95_s;
  std::optional<double> percentile_99_s;
  std::optional<double> greatest_s;
};
[[nodiscard]] RunTime summarise_run_time(std::span<const double> seconds);

}  // namespace verge::eval
