// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "verge/core/vec.hpp"
#include "verge/detect/lda/lda.hpp"
#include "verge/detect/lda/windows.hpp"
#include "verge/model/scene.hpp"
#include "verge/scan/quadrants.hpp"

namespace verge::detect::lda {

/// The windows that the discriminant takes for edges.
[[nodiscard]] std::vector<Window> edge_windows(std::span<const Window> windows, const LdaConfig& config);

/// Where a scan line meets the edge of the road: the outer end of the edge window that is nearest to the
/// vehicle (laterally), at the least height of its returns. Of all edge windows the nearest has just reached
/// so far up the face that it is one: its outer end lies on the face, and its middle before it, or below.
/// None without edge windows.
[[nodiscard]] std::optional<Vec3> nearest_edge(const QuadrantRing& ring, std::span<const Window> edges,
                                               const LdaConfig& config);

/// A boundary in the level frame, and the places that it was fitted to.
struct SideFit {
  Boundary boundary;
  std::vector<Vec3> kept;
};

/// One side of the road through the places where its scan lines meet it: least squares of lateral on forward,
/// again and again without what is farther off than reject_sigma deviations (of at least 10 cm), beginning
/// with a robust curve. A line, where its residuals allow (line_residual_m) and it agrees with no fewer
/// places than a quadratic does; else the quadratic. confidence = n / (n + rejected + 3): it orders
/// boundaries, and is not calibrated. None where fewer than points_min are left, or they have fewer than two
/// places ahead.
[[nodiscard]] std::optional<SideFit> fit_side(const std::vector<Vec3>& places, bool right,
                                              const LdaConfig& config);

}  // namespace verge::detect::lda
