// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "verge/study/engine.hpp"
#include "verge/study/plot.hpp"

namespace verge::study {

/// The plots that a suite's results can carry: success of each cell, precision over recall, errors and recall
/// by range, F1 by tolerance, degradation curves; those without a point are left out.
[[nodiscard]] std::vector<Plot> plots_of(const Results& results);

}  // namespace verge::study
