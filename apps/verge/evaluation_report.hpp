// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "verge/eval/boundary_error.hpp"

namespace verge::app {

/// The table of `verge evaluate`: a row for the scans of each road shape that occurs and one for all.
[[nodiscard]] std::string evaluation_table(const eval::Comparison& comparison,
                                           const eval::BoundaryErrorConfig& config);

/// The same as one JSON object, with the figures of each scan; a figure that does not exist or is not finite
/// is null.
[[nodiscard]] std::string evaluation_json(const eval::Comparison& comparison,
                                          const eval::BoundaryErrorConfig& config);

}  // namespace verge::app
