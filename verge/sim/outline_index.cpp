// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/sim/outline_index.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace verge::sim {
namespace {

constexpr double kCell_m = 4.0;

std::int64_t cell_index(double coordinate) {
  return static_cast<std::int64_t>(std::floor(coordinate / kCell_m));
}

}  // namespace

OutlineIndex::OutlineIndex(const Outline& outline) : outline_(outline) {
  Vec2 high = low_ = outline.loops.front().vertices.front().position;
  for (const OutlineLoop& loop : outline.loops) {
    for (const OutlineVertex& v : loop.vertices) {
      low_ = {std::min(low_.x, v.position.x), std::min(low_.y, v.position.y)};
      high = {std::max(high.x, v.position.x), std::max(high.y, v.position.y)};
    }
  }
  columns_ = cell_index(high.x - low_.x) + 1;
  rows_ = cell_index(high.y - low_.y) + 1;
  cells_.resize(static_cast<std::size_t>(columns_ * rows_));
  for (std::uint32_t l = 0; l < outline.loops.size(); ++l) {
    for (std::uint32_t v = 0; v < outline.loops[l].vertices.size(); ++v) enter({l, v});
  }
}

Vec2 OutlineIndex::vertex(std::size_t loop, std::size_t index) const {
  const auto& vertices = outline_.loops[loop].vertices;
  return vertices[index % vertices.size()].position;
}

std::size_t OutlineIndex::cell_of(std::int64_t column, std::int64_t row) const {
  return static_cast<std::size_t>(row * columns_ + column);
}

// Into every cell of the box around the stretch.
void OutlineIndex::enter(Stretch stretch) {
  const Vec2 a = vertex(stretch.loop, stretch.vertex) - low_;
  const Vec2 b = vertex(stretch.loop, stretch.vertex + 1) - low_;
  for (std::int64_t row = cell_index(std::min(a.y, b.y)); row <= cell_index(std::max(a.y, b.y)); ++row) {
    for (std::int64_t c = cell_index(std::min(a.x, b.x)); c <= cell_index(std::max(a.x, b.x)); ++c) {
      cells_[cell_of(c, row)].push_back(stretch);
    }
  }
}

void OutlineIndex::look(std::int64_t column, std::int64_t row, Vec2 p, double& least,
                        NearestEdge& best) const {
  if (column < 0 || row < 0 || column >= columns_ || row >= rows_) return;
  for (const Stretch& stretch : cells_[cell_of(column, row)]) {
    const Vec2 a = vertex(stretch.loop, stretch.vertex);
    const Vec2 ab = vertex(stretch.loop, stretch.vertex + 1) - a;
    const double share = std::clamp(dot(p - a, ab) / dot(ab, ab), 0.0, 1.0);
    const Vec2 foot = a + share * ab;
    const double away = distance(p, foot);
    if (away >= least) continue;
    least = away;
    best = {away, stretch.loop, stretch.vertex, share, foot};
  }
}

// The surface lies to the left. At a vertex both stretches decide together (Baerentzen and Aanaes 2005).
void OutlineIndex::settle_sign(Vec2 p, NearestEdge& best) const {
  const auto direction = [&](std::size_t v) {
    const Vec2 d = vertex(best.loop, v + 1) - vertex(best.loop, v);
    return (1.0 / norm(d)) * d;
  };
  const std::size_t count = outline_.loops[best.loop].vertices.size();
  Vec2 ahead = direction(best.vertex);
  if (best.share == 0.0) ahead = ahead + direction((best.vertex + count - 1) % count);
  if (best.share == 1.0) ahead = ahead + direction((best.vertex + 1) % count);
  if (cross(ahead, p - best.foot) > 0.0) best.outside_m = -best.outside_m;
}

NearestEdge OutlineIndex::nearest(Vec2 p) const {
  const Vec2 q = p - low_;
  const std::int64_t column = std::clamp<std::int64_t>(cell_index(q.x), 0, columns_ - 1);
  const std::int64_t row = std::clamp<std::int64_t>(cell_index(q.y), 0, rows_ - 1);
  double least = std::numeric_limits<double>::infinity();
  NearestEdge best;
  for (std::int64_t ring = 0; ring <= std::max(columns_, rows_); ++ring) {
    // What ring k of cells around p's (or, for p beside the grid, the nearest one) holds is (k - 1) cells
    // away.
    if (least <= kCell_m * static_cast<double>(ring - 1)) break;
    for (std::int64_t r = row - ring; r <= row + ring; ++r) {
      const bool whole = r == row - ring || r == row + ring;
      const std::int64_t step = whole ? 1 : std::max<std::int64_t>(1, 2 * ring);
      for (std::int64_t c = column - ring; c <= column + ring; c += step) look(c, r, p, least, best);
    }
  }
  settle_sign(p, best);
  return best;
}

}  // namespace verge::sim
