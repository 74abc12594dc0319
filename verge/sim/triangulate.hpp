// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "verge/core/vec.hpp"

namespace verge::sim {

/// A line between two points that must be an edge of triangles.
struct FixedEdge {
  enum class Kind : std::uint8_t {
    kBorder,  ///< Parts inside from outside.
    kCrease,  ///< Only keeps triangles from lying across; left out where it would cross a border.
  };
  std::uint32_t from = 0;
  std::uint32_t to = 0;
  Kind kind = Kind::kBorder;
};

/// Triangles over points of the plane.
struct Triangulation {
  std::vector<std::array<std::uint32_t, 3>> inside;   ///< Within an odd number of borders.
  std::vector<std::array<std::uint32_t, 3>> outside;  ///< The rest, out to the frame.
  std::vector<Vec2> points;  ///< The given points, then the four corners of the frame.
};

/// The constrained Delaunay triangulation of the points within a square frame that reaches `margin_m` (at
/// least 1 m) beyond them: triangles as near to equilateral as the fixed edges allow, counter-clockwise.
/// Which way an edge lies is decided in whole numbers of 4 um, without rounding; coordinates are kept as they
/// are. Points that fall together there are one point, the first of them. Sources: Lawson 1977 (flips);
/// Sloan 1993 (fixed edges). Throws std::invalid_argument where two borders cross (with the place) or the
/// frame is wider than 4 km. The same arguments give the same triangles.
[[nodiscard]] Triangulation triangulate(std::span<const Vec2> points, std::span<const FixedEdge> edges,
                                        double margin_m);

}  // namespace verge::sim
