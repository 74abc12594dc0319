// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "verge/detect/gradient/curve.hpp"
#include "verge/detect/gradient/denoise.hpp"
#include "verge/detect/gradient/gradient.hpp"
#include "verge/model/scene.hpp"

namespace verge::detect::gradient {

/// A boundary still in the level frame, and the curve that it was made from.
struct Fitted {
  Boundary boundary;
  Curve curve;
};

/// III for each strand. Heights, rises and states along the curve are those of the strand's points at the
/// same share of its length. confidence = n / (n + scan lines missed + 3), halved for walls: it orders
/// boundaries, and is not calibrated.
[[nodiscard]] std::vector<Fitted> fit_boundaries(const std::vector<Strand>& strands,
                                                 const GradientConfig& config);

/// Paper reading: one curve a side through all points of the side's clusters (P3-24: right = a and c, left =
/// b and d).
[[nodiscard]] std::optional<Fitted> fit_side_as_printed(const std::vector<Vec3>& points, bool right,
                                                        const GradientConfig& config);

}  // namespace verge::detect::gradient
