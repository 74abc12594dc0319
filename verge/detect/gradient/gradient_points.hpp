// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "verge/detect/gradient/gradient.hpp"
#include "verge/detect/gradient/regions.hpp"

namespace verge::detect::gradient {

/// The returns of one layer that have the gradient of a boundary: heights that increase outward, from the
/// road.
struct GradientPoints {
  std::vector<std::size_t> index;  ///< Into Layer::points, ascending.
  std::vector<double> rise_m;      ///< For each: how much what follows stands above what came before.
};

/// II-1 (2), fixed reading. The paper looks for "obvious" increase along the scan line; on a vertical face
/// that gradient is only tan(elevation) sin(azimuth), a few degrees far out, and a road's cross-fall is as
/// much (A2.2-1). So the height is held against the road's own slope: a straight line through the last
/// before_m of ring, extrapolated over the next after_m. A return has the gradient where the mean of what
/// follows rises above that line by rise_min_m and by noise_factor standard errors.
[[nodiscard]] GradientPoints gradient_points(const Layer& layer, const GradientConfig& config);

/// II-1 (2), paper reading: runs of at least points_min returns whose heights increase outward, with at most
/// 30 % falling steps and a rise in [rise_min_m, rise_max_m] (settled reading 4). rise_m is the run's.
[[nodiscard]] GradientPoints gradient_points_as_printed(const Layer& layer, const GradientConfig& config);

/// Length along the layer across the beams at each of its points, metres, from 0 at the first. Where a scan
/// line climbs a kerb ahead it also comes a long way nearer: by 1.6 m in five returns at 20 m, and the rise
/// over that length is as little as a road's own slope. Across the beams the same rise is steep.
///
/// No gradient is measured over a gap wider than gap_min_m and gap_factor point spacings: one across the
/// beams (returns are missing), or one along them where the height changes by more than climb_m (a shadow, an
/// obstacle; a kerb seen along its own direction changes less). What lies behind a gap is put farther off
/// than any window reaches.
[[nodiscard]] std::vector<double> arc_of(const Layer& layer, const GradientConfig& config);

}  // namespace verge::detect::gradient
