// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "verge/model/trace.hpp"

namespace verge::app {

/// {"points": [{"name": ..., "points": [[x, y, z], ...], "group": [...]}], "lines": [...], "values": [...],
/// "rasters": [{"name": ..., "rows": ..., "cols": ..., "x": {"name": ..., "unit": ..., "first": ..., "step":
/// ...}, "y": ..., "values": [...]}]} on one line: every layer in its order; coordinates to 0.1 mm, values as
/// they are, null where not finite.
[[nodiscard]] std::string to_json(const Trace& trace);

}  // namespace verge::app
