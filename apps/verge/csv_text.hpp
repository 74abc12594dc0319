// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace verge::app {

/// The cells as one row of CSV with its line's end; cells with commas, quotes or ends of lines are quoted.
[[nodiscard]] std::string csv_row(const std::vector<std::string>& cells);

}  // namespace verge::app
