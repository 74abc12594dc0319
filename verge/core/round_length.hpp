// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <initializer_list>

namespace verge {

/// The greatest of 1, 2 and 5 times a power of ten that is not above `length` (which is positive): for ticks
/// and scale bars.
[[nodiscard]] inline double round_length(double length) {
  const double power = std::pow(10.0, std::floor(std::log10(length)));
  for (const double factor : {5.0, 2.0}) {
    if (factor * power <= length) return factor * power;
  }
  return power;
}

}  // namespace verge
