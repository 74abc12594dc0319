// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/sim/section.hpp"

#include <algorithm>
#include <cstddef>

namespace verge::sim {
namespace {

constexpr double kFall = 0.05;       // from the sidewalk to the plain
constexpr double kGrassFall = 0.04;  // from the edge to the plain
constexpr double kWallTop_m = 0.3;
constexpr double kWallBack = 3.0;  // slope of the ground behind a wall

bool has_sidewalk(const Section& s) { return !s.is_end && (s.edge == Edge::kKerb || s.edge == Edge::kFlush); }

// Down (or up) to the plain at that slope.
void reach_plain(std::vector<Vec2>& line, double plain, double slope) {
  const Vec2 from = line.back();
  if (from.y > plain) line.push_back({from.x + (from.y - plain) / slope, plain});
}

std::vector<Vec2> ditch(const Section& s) {
  const double shoulder = s.edge_m - kGrassFall;
  const double bottom = shoulder - 0.6;
  return {{0.0, s.edge_m}, {1.0, shoulder}, {1.9, bottom}, {2.3, bottom}, {3.2, s.plain_m}};
}

double between(const std::vector<Vec2>& line, double x) {
  for (std::size_t i = 0; i + 1 < line.size(); ++i) {
    const Vec2 a = line[i];
    const Vec2 b = line[i + 1];
    if (x <= b.x && b.x > a.x) return a.y + (b.y - a.y) * std::max(0.0, x - a.x) / (b.x - a.x);
  }
  return line.back().y;
}

}  // namespace

std::vector<Vec2> face_of(const Section& section) {
  const double h = section.step_m;
  if (h <= 0.0) return {{0.0, 0.0}};
  if (section.edge == Edge::kKerb && section.face == KerbFace::kSloped) return {{0.0, 0.0}, {0.6 * h, h}};
  if (section.edge == Edge::kKerb && section.face == KerbFace::kWorn) {
    return {{0.0, 0.0}, {0.05 * h, 0.5 * h}, {0.2 * h, 0.85 * h}, {0.5 * h, h}};
  }
  return {{0.0, 0.0}, {0.0, h}};
}

std::vector<Vec2> profile_of(const Section& section) {
  if (!section.is_end && section.edge == Edge::kDitch) return ditch(section);
  const Vec2 top = face_of(section).back() + Vec2{0.0, section.edge_m};
  std::vector<Vec2> line = {top};
  if (has_sidewalk(section)) {
    const double width = section.sidewalk_m;
    if (width > 0.0) line.push_back(top + Vec2{width, section.slope * width});
    reach_plain(line, section.plain_m, kFall);
  } else if (section.edge == Edge::kWall && !section.is_end) {
    line.push_back(top + Vec2{kWallTop_m, 0.0});
    reach_plain(line, section.plain_m, kWallBack);
  } else {
    reach_plain(line, section.plain_m, kGrassFall);
  }
  return line;
}

double height_at(const Section& section, double outside_m) {
  const std::vector<Vec2> face = face_of(section);
  if (outside_m < face.back().x) return section.edge_m + between(face, outside_m);
  return between(profile_of(section), outside_m);
}

Surface surface_at(const Section& section, double outside_m) {
  const double top = face_of(section).back().x;
  if (has_sidewalk(section)) {
    if (outside_m < top) return Surface::kCurb;
    return outside_m < top + section.sidewalk_m ? Surface::kSidewalk : Surface::kGround;
  }
  const bool on_wall = section.edge == Edge::kWall && !section.is_end && outside_m < kWallTop_m;
  return on_wall ? Surface::kWall : Surface::kGround;
}

}  // namespace verge::sim
