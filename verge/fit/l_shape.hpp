// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "verge/core/fields.hpp"
#include "verge/core/vec.hpp"

namespace verge::fit {

/// What makes one heading better than another. Zhang, Xu, Dong, Dolan, "Efficient L-Shape Fitting for Vehicle
/// Detection Using Laser Scanners" (IEEE Intelligent Vehicles Symposium 2017).
enum class LShapeCriterion : std::uint8_t {
  kCloseness,  ///< Algorithm 4: the sum of 1 / distance from the nearer edge is greatest.
  kVariance,   ///< Algorithm 5: the distances vary least, among the points of each edge.
};

}  // namespace verge::fit

namespace verge {
template <>
inline constexpr std::array enum_names<fit::LShapeCriterion> =
    std::to_array<std::string_view>({"closeness", "variance"});
}  // namespace verge

namespace verge::fit {

struct LShapeOptions {
  LShapeCriterion criterion = LShapeCriterion::kCloseness;
  double step_rad = 0.017453292519943295;    ///< Of the search over a quarter turn.
  double refine_rad = 0.001745329251994330;  ///< Of the second search, around the best of the first.
  double nearest_m = 0.03;  ///< d_0: closer to an edge than this is no better; the ranges' deviation.
};

/// One edge of an L.
struct LEdge {
  std::vector<std::size_t> points{};  ///< That belong to it, ascending.
  Vec2 begin;          ///< The foot of its point nearest to the corner; the corner where it has none.
  Vec2 end;            ///< And of the farthest one.
  double rms_m = 0.0;  ///< Of the distances of its points.
};

/// The two sides of a rectangle that look towards the viewer, as its points show them.
struct LShape {
  Vec2 corner;                 ///< Where the edges meet: the rectangle's corner nearest to the viewer.
  double heading_rad = 0.0;    ///< Of one of the edges, in [0, pi/2): that of the other is a quarter turn on.
  std::array<LEdge, 2> edges;  ///< The first runs along heading_rad (or back), the second across.
};

/// How good a heading is, more is better: what the search makes greatest. `viewer` says which sides of the
/// rectangle around the points are its edges: those that look towards it (the paper takes those that the
/// points are nearer to, which a single face leaves open).
[[nodiscard]] double l_shape_score(std::span<const Vec2> points, Vec2 viewer, double heading_rad,
                                   const LShapeOptions& options = {});

/// The L shape of the best heading: searched in steps over a quarter turn, then in fine steps, then by least
/// squares of the distances from both edges at once, each point belonging to the edge that it is nearer to.
/// Where one edge has all points (a single face, whose heading the criteria hardly tell), that is fit_line.
/// Turning, mirroring or moving points and viewer turns, mirrors or moves the result; their order plays no
/// part but in the rounding. Degenerate: fewer than 2 distinct points, or a coordinate that is not finite,
/// give none.
[[nodiscard]] std::optional<LShape> fit_l_shape(std::span<const Vec2> points, Vec2 viewer,
                                                const LShapeOptions& options = {});

/// The L shape of a given heading, each point belonging to the edge that it is nearer to; an edge lies at the
/// mean of its points, and where it has none at the outermost point of all. Degenerate as fit_l_shape.
[[nodiscard]] std::optional<LShape> l_shape_along(std::span<const Vec2> points, Vec2 viewer,
                                                  double heading_rad);

}  // namespace verge::fit
