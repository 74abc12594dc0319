// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "verge/core/vec.hpp"
#include "verge/fit/residuals.hpp"
#include "verge/fit/robust.hpp"

namespace verge::fit {

/// A straight line in the plane, metres.
struct Line {
  Vec2 centroid;  ///< A point of the line: for least squares the (weighted) mean of the points fitted to.
  Vec2 direction{1.0, 0.0};  ///< Unit vector with x > 0, or (0, 1).
};

/// Where the foot of p lies along the line, metres from the centroid, positive along the direction.
[[nodiscard]] inline double station(const Line& line, Vec2 p) {
  return dot(line.direction, p - line.centroid);
}
/// Orthogonal distance of p, metres, positive to the left of the direction.
[[nodiscard]] inline double signed_distance(const Line& line, Vec2 p) {
  return cross(line.direction, p - line.centroid);
}
/// The line's point at that station.
[[nodiscard]] inline Vec2 point_at(const Line& line, double station_m) {
  return line.centroid + station_m * line.direction;
}

/// The line through `point` along `direction`, which may have any length but 0.
[[nodiscard]] Line line_along(Vec2 point, Vec2 direction);

struct LineFit {
  Line line;
  Residuals residuals;          ///< Orthogonal for every fit of a line, so that they compare.
  std::vector<double> weights;  ///< What each point weighed in the end.
};

/// The line with its residuals at the points. `weights`: empty, or one for each point, one of them positive;
/// `final_weights`: what the fit made of them.
[[nodiscard]] LineFit measured(const Line& line, std::span<const Vec2> points,
                               std::span<const double> weights, std::vector<double> final_weights);

/// The lines of fit_line and fit_line_ordinary below alone, for those who need no residuals: measuring them
/// takes several times as long. Degenerate: as there.
[[nodiscard]] std::optional<Line> orthogonal_line(std::span<const Vec2> points,
                                                  std::span<const double> weights = {});
[[nodiscard]] std::optional<Line> ordinary_line(std::span<const Vec2> points,
                                                std::span<const double> weights = {});

/// Straight line by orthogonal (total) least squares: it goes through the weighted mean along the principal
/// axis of the scatter, and turning the points turns the line. `weights`: empty, or one finite weight >= 0
/// for each point. Where no axis is better than another (the corners of a square), +x. Degenerate: fewer than
/// 2 distinct points of positive weight, or a coordinate that is not finite, give none.
[[nodiscard]] std::optional<LineFit> fit_line(std::span<const Vec2> points,
                                              std::span<const double> weights = {});

/// Straight line by ordinary least squares of y on x, paper 3's "least square method" (III; P3-9) as it is
/// printed. In the vehicle's frame this is lateral on forward, the axes in which a road's edge is a function;
/// it flattens lines that are steep in x. Degenerate: as fit_line, and none where all x are equal.
[[nodiscard]] std::optional<LineFit> fit_line_ordinary(std::span<const Vec2> points,
                                                       std::span<const double> weights = {});

/// fit_line with the points reweighted by their residuals (see RobustOptions): points far from the line that
/// most points agree on lose their say. The residuals' figures still count every point with its own weight.
/// Degenerate: as fit_line.
[[nodiscard]] std::optional<LineFit> fit_line_robust(std::span<const Vec2> points,
                                                     const RobustOptions& options = {},
                                                     std::span<const double> weights = {});

}  // namespace verge::fit
