// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "verge/pipeline/run.hpp"
#include "verge/pipeline/summary.hpp"

namespace verge::app {

/// "mount: height 1.84 m, pitch 0.3 deg, roll -0.2 deg, forward 1.2 deg (estimated from the scan)".
[[nodiscard]] std::string mount_line(const MountEstimate& estimate, const MountHint& hint);

/// What a run did and how long each stage took, as the lines that close it. `seconds` is the run's own time.
[[nodiscard]] std::string closing_table(const pipeline::Summary& summary, double seconds);

}  // namespace verge::app
