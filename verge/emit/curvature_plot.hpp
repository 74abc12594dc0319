// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "verge/core/error.hpp"
#include "verge/model/trace.hpp"

namespace verge::emit {

/// The curvature along one B-spline boundary (paper 3, III-2).
struct CurvatureCurve {
  std::vector<double> s_m;        ///< Place of each point along the boundary, ascending.
  std::vector<double> kappa_1_m;  ///< Curvature 1 / rho_i of each of them, 1/m.
  std::vector<double> key_s_m;    ///< Places of those that are key points.
};

/// Of each B-spline of a trace, in its order: values "s", "kappa" and "key s". One whose "s" and "kappa" are
/// not equally many is left out.
[[nodiscard]] std::vector<CurvatureCurve> curvature_curves(const Trace& trace);

/// The distribution of curvature along a boundary as PNG, 1200 pixels wide (paper 3, Fig. 4): the curvature
/// over the place, the threshold [k] = k_avg (the mean between the two ends) dashed, and the key points:
/// discs where the curvature reaches it, rings where it does not (the ends, and what was put between key
/// points that lie far apart). Points that are not finite are left out. Fails with kLimit where memory does
/// not suffice.
[[nodiscard]] Expected<std::string> curvature_png(const CurvatureCurve& curve);

}  // namespace verge::emit
