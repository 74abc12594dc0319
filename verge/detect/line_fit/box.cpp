// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/detect/line_fit/box.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace verge::detect::line_fit {
namespace {

double length_m(const fit::LEdge& edge) { return distance(edge.begin, edge.end); }

double roughness_m(const fit::LShape& shape) {
  double squares = 0.0;
  double returns = 0.0;
  for (const fit::LEdge& edge : shape.edges) {
    squares += static_cast<double>(edge.points.size()) * edge.rms_m * edge.rms_m;
    returns += static_cast<double>(edge.points.size());
  }
  return std::sqrt(squares / returns);
}

/// Whether an edge holds returns enough, and is long enough, to be a face: the returns of all layers at the
/// end of the other edge lie near the corner too.
bool is_face(const fit::LEdge& edge) {
  constexpr std::size_t kReturns = 3;
  constexpr double kLength_m = 0.15;
  return edge.points.size() >= kReturns && length_m(edge) >= kLength_m;
}

/// Along the axis from the corner: where the points of a face are, else away from the sensor.
Vec2 onward_of(const fit::LShape& shape, const fit::LEdge& edge, bool is_face, Vec2 axis) {
  const Vec2 middle = 0.5 * (edge.begin + edge.end) - shape.corner;
  return dot(is_face ? middle : shape.corner, axis) < 0.0 ? -1.0 * axis : axis;
}

/// Whether the outline is seen to turn at the corner into that edge, be it with a single return: one that
/// stands farther along it than noise puts those of the other edge, which runs along `other`.
bool turns_into(const fit::LEdge& edge, Vec2 corner, Vec2 other, double sigma_m) {
  constexpr double kDeviations = 4.0;
  constexpr double kLeast_m = 0.02;
  const double incidence = std::fabs(cross(corner, other)) / norm(corner);  // sine
  return distance(corner, edge.end) > kLeast_m + kDeviations * sigma_m * incidence;
}

/// Along an edge that is a face; `turns`: the outline turns at the corner, where this edge then begins.
Extent seen_extent(const Outline& outline, const fit::LEdge& edge, Vec2 onward, const Beside& beside,
                   bool turns) {
  Extent extent;
  extent.high_m = dot(edge.end - outline.corner, onward);
  extent.above = beside.after(edge.end, onward);
  if (turns) {
    extent.below = {.unseen_m = 0.0};
    return extent;
  }
  extent.low_m = dot(edge.begin - outline.corner, onward);
  extent.below = beside.after(edge.begin, -1.0 * onward);
  return extent;
}

/// Away from a face, behind which nobody sees.
Extent depth_extent() { return {.below = {.unseen_m = 0.0}}; }

}  // namespace

Outline outline_of(const fit::LShape& shape, const Beside& beside, double sigma_m) {
  const Vec2 along{std::cos(shape.heading_rad), std::sin(shape.heading_rad)};
  const std::array<Vec2, 2> axes = {along, {-along.y, along.x}};
  Outline outline{.corner = shape.corner};
  for (const fit::LEdge& edge : shape.edges) outline.returns += edge.points.size();
  outline.rough_m = roughness_m(shape);
  for (std::size_t i = 0; i < 2; ++i) outline.face.at(i) = is_face(shape.edges.at(i));
  if (!outline.face[0] && !outline.face[1])
    outline.face.at(length_m(shape.edges[0]) >= length_m(shape.edges[1]) ? 0 : 1) = true;
  for (std::size_t i = 0; i < 2; ++i)
    outline.onward.at(i) = onward_of(shape, shape.edges.at(i), outline.face.at(i), axes.at(i));
  for (std::size_t i = 0; i < 2; ++i) {
    if (!outline.face.at(i)) {
      outline.extent.at(i) = depth_extent();
      continue;
    }
    const bool turns = turns_into(shape.edges.at(1 - i), shape.corner, outline.onward.at(i), sigma_m);
    outline.extent.at(i) = seen_extent(outline, shape.edges.at(i), outline.onward.at(i), beside, turns);
  }
  return outline;
}

Extent completed(const Extent& extent, double usual_m) {
  const double seen_m = extent.seen_m();
  constexpr double kSmallest = 0.8;  // of the usual size: what looks smaller was not seen whole
  const double most_m = std::max({seen_m, extent.bound_m(), kSmallest * usual_m});
  const double more_m = std::clamp(usual_m, seen_m, most_m) - seen_m;
  const double below_m = extent.below.unseen_m;
  const double above_m = extent.above.unseen_m;
  double share = 0.5;  // of what is added, below
  if (std::isinf(below_m) != std::isinf(above_m)) {
    share = std::isinf(below_m) ? 1.0 : 0.0;
  } else if (std::isfinite(below_m)) {
    share = below_m > 0.0 ? below_m / (below_m + above_m) : 0.0;
  }
  return {.low_m = extent.low_m - share * more_m, .high_m = extent.high_m + (1.0 - share) * more_m};
}

}  // namespace verge::detect::line_fit
