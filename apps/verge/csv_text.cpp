// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "apps/verge/csv_text.hpp"

#include "verge/core/csv_field.hpp"

namespace verge::app {
std::string csv_row(const std::vector<std::string>& cells) {
  std::string row;
  for (const std::string& cell : cells) row += csv_field(cell) + ",";
  if (!row.empty()) row.pop_back();
  return row + "\n";
}

}  // namespace verge::app
