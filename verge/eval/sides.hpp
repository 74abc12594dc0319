// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "verge/model/scene.hpp"

namespace verge::eval {

/// Whether boundaries of these sides are compared with each other: left with left, right with right, an
/// island or an unnamed side with any.
[[nodiscard]] constexpr bool goes_with(Side a, Side b) {
  const auto any = [](Side side) { return side == Side::kIsland || side == Side::kOther; };
  return a == b || any(a) || any(b);
}

}  // namespace verge::eval
