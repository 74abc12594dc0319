// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <variant>
#include <vector>

#include "verge/core/vec.hpp"
#include "verge/detect/line_fit/line_fit.hpp"
#include "verge/fit/line.hpp"
#include "verge/fit/polynomial.hpp"

namespace verge::detect::line_fit {

/// What was put through points: a line, or y as a polynomial of x (level frame).
using Curve = std::variant<fit::Line, fit::Polynomial>;

/// Where the place lies along the curve, metres, forward: along a line from its centroid; of a polynomial, x.
[[nodiscard]] double station_on(const Curve& curve, Vec2 place);
/// The curve's point there.
[[nodiscard]] Vec2 place_on(const Curve& curve, double station_m);

/// The estimator's curve through the points; none where they are too few, or stand on one x where y is a
/// function of it. Hough lines are those of hough_lines(). (P2 III-B, III-C, V-C)
[[nodiscard]] std::optional<Curve> estimate(std::span<const Vec2> points, EdgeEstimator estimator,
                                            const LineFitConfig& config);

/// A curve and the points that it was put through.
struct Edge {
  Curve curve;
  std::vector<std::size_t> points{};  ///< Into the layer points.
  double from_m = 0.0;                ///< Stations of the first and of the last of them.
  double to_m = 0.0;

  [[nodiscard]] double length_m() const { return to_m - from_m; }
};

/// The edge with its ends. `places` are those of all layer points; `points` must not be empty.
[[nodiscard]] Edge edge_of(Curve curve, std::vector<std::size_t> points, std::span<const Vec2> places);

}  // namespace verge::detect::line_fit
