// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/eval/run_time.hpp"

#include "verge/core/statistics.hpp"

namespace verge::eval {

RunTime summarise_run_time(std::span<const double> seconds) {
  return {.scans = seconds.size(),
          .median_s = median(seconds),
          .percentile_95_s = percentile(seconds, 95.0),
          .percentile_99_s = percentile(seconds, 99.0),
          .greatest_s = percentile(seconds, 100.0)};
}

}  // namespace verge::eval
