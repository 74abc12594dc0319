// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>

#include "verge/detect/road_width/kerb_profile.hpp"

namespace verge::detect::road_width {

/// Radii, metres.
struct RadiusRange {
  double least = 0.0;
  double most = 0.0;
};

/// How the kerb turns into a side road: along a circle that touches the straight kerb.
struct KerbReturn {
  double begin_m = 0.0;   ///< Along the way: where it leaves the straight kerb.
  double sigma_m = 0.0;   ///< Standard deviation of it.
  double radius_m = 0.0;  ///< Geometric mean.
  double wide = 0.0;      ///< Probability that the radius is one of those asked for, 0..1.
  double share = 0.0;     ///< Of the points beyond the kerb, those that lie on the likeliest circle, 0..1.
};

/// The circle behind points from a little before an opening on, `first_m` the first of them that left the
/// kerb: mean and spread over all begins and radii (0.25 to 32 m), each as likely as the points within it
/// make it, with `sigma_m` the error of a point across the kerb. Beyond 1.5 m, one depth is as good as
/// another. None without a point.
[[nodiscard]] std::optional<KerbReturn> fit_kerb_return(std::span<const KerbPoint> points, double first_m,
                                                        double sigma_m, RadiusRange wide_m);

}  // namespace verge::detect::road_width
