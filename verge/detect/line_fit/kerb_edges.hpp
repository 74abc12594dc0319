// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "verge/detect/line_fit/kerb_pieces.hpp"

namespace verge::detect::line_fit {

/// The returns of the left and of the right kerb, indices into the layer points, ascending; empty where none
/// was seen. A side's kerb is the line that most returns of its pieces lie on, of several nearly as good ones
/// the innermost, with all low returns near to it: what objects hide parts it into pieces that no single
/// line fit would join.
struct KerbReturns {
  std::vector<std::size_t> left{};
  std::vector<std::size_t> right{};
};
[[nodiscard]] KerbReturns kerb_returns(std::span<const LayerPoint> points, std::span<const Object> objects,
                                       const KerbConfig& config);

}  // namespace verge::detect::line_fit
