// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/sim/land_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "verge/sim/land.hpp"
#include "verge/sim/triangulate.hpp"

namespace verge::sim {
namespace {

constexpr double kLongestStep_m = 2.0;
constexpr double kFineReach_m = 12.0;    // beside the road, where bumps are resolved
constexpr double kCoarseReach_m = 80.0;  // where the shape of the land is
constexpr double kCoarse_m = 5.0;
constexpr double kGrassReach_m = 5.0;
constexpr double kGrassStep_m = 0.25;
constexpr double kCrownStep_m = 0.5;  // at mouths, where crowns meet
constexpr double kMargin_m = 150.0;

// Three vertices from bump to bump; 0 where the ground is smooth.
double fine_step(const GroundConfig& ground) {
  return ground.roughness_m > 0.0 ? ground.roughness_length_m / 3.0 : 0.0;
}

// Outward at a vertex, so long that the line beside keeps its distance from both stretches that meet there.
Vec2 outward_at(const OutlineLoop& loop, std::size_t v) {
  const std::size_t n = loop.vertices.size();
  const auto normal = [&](std::size_t from) {  // to the right of the walk
    const Vec2 d = loop.vertices[(from + 1) % n].position - loop.vertices[from].position;
    return (1.0 / norm(d)) * Vec2{d.y, -d.x};
  };
  const Vec2 before = normal((v + n - 1) % n);
  const Vec2 sum = before + normal(v);
  const double reach = dot(sum, before);
  return reach > 0.2 ? (1.0 / reach) * sum : before;
}

/// Points of a triangulation, and the borders and creases among them.
struct Plan {
  std::vector<Vec2> points;
  std::vector<FixedEdge> edges;

  void add_line(const std::vector<Vec2>& line, bool closed, FixedEdge::Kind kind) {
    const auto first = static_cast<std::uint32_t>(points.size());
    const auto count = static_cast<std::uint32_t>(line.size());
    points.insert(points.end(), line.begin(), line.end());
    for (std::uint32_t i = 0; i + 1 < count; ++i) edges.push_back({first + i, first + i + 1, kind});
    if (closed) edges.push_back({first + count - 1, first, kind});
  }
};

struct Box {
  Vec2 low;
  Vec2 high;
};

Box around(Vec2 center, double reach) { return {center - Vec2{reach, reach}, center + Vec2{reach, reach}}; }

Box box_of(const Outline& outline) {
  Box box = around(outline.loops.front().vertices.front().position, 0.0);
  for (const OutlineLoop& loop : outline.loops) {
    for (const OutlineVertex& v : loop.vertices) {
      box.low = {std::min(box.low.x, v.position.x), std::min(box.low.y, v.position.y)};
      box.high = {std::max(box.high.x, v.position.x), std::max(box.high.y, v.position.y)};
    }
  }
  return box;
}

template <class Visit>
void visit_lattice(const Box& box, double step, double margin, const Visit& visit) {
  const auto first = [&](double low) { return std::floor((low - margin) / step); };
  for (double c = first(box.low.x); step * c <= box.high.x + margin; c += 1.0) {
    for (double r = first(box.low.y); step * r <= box.high.y + margin; r += 1.0)
      visit(Vec2{step * c, step * r});
  }
}

/// Makes the mesh of one land: the carriageway and what lies beside it are triangulated each by itself; faces
/// of steps join them.
class Mesher {
 public:
  explicit Mesher(const Land& land) : land_(land), box_(box_of(land.outline())) {}

  [[nodiscard]] World make() {
    plan_outlines();
    plan_creases();
    plan_crowns();
    plan_bumps();
    plan_grass();
    plan_slopes();
    add_road();
    add_beside();
    add_faces();
    world_.object.assign(world_.triangles.size(), 0);
    return std::move(world_);
  }

 private:
  void plan_outlines();
  void plan_rows(std::size_t loop);
  void plan_creases();
  void plan_crowns();
  void plan_bumps();
  void plan_grass();
  void plan_slopes();
  void add_road();
  void add_beside();
  void add_faces();
  void add_face(std::size_t loop, std::size_t vertex);
  void add_lattice_point(Vec2 p, double step, double reach);
  [[nodiscard]] std::vector<Vec3> face_at(std::size_t loop, std::size_t vertex) const;
  void add_triangles(const std::vector<std::array<std::uint32_t, 3>>& triangles, std::uint32_t first,
                     bool road);

  const Land& land_;
  Box box_;
  Plan road_;
  Plan beside_;
  std::vector<double> foot_height_;  // of the first points of road_
  std::vector<double> top_height_;   // of the first points of beside_: the tops of the steps
  World world_;
};

std::vector<Vec3> Mesher::face_at(std::size_t loop, std::size_t vertex) const {
  const OutlineLoop& line = land_.outline().loops[loop];
  const Vec3 foot = land_.foot(loop, vertex);
  const Vec2 outward = outward_at(line, vertex);
  std::vector<Vec3> face;
  for (const Vec2 at : face_of(land_.section(loop, vertex))) {
    face.push_back(foot + Vec3{at.x * outward.x, at.x * outward.y, at.y});
  }
  return face;
}

void Mesher::plan_outlines() {
  for (std::size_t l = 0; l < land_.outline().loops.size(); ++l) {
    std::vector<Vec2> feet;
    std::vector<Vec2> tops;
    for (std::size_t v = 0; v < land_.outline().loops[l].vertices.size(); ++v) {
      feet.push_back(land_.outline().loops[l].vertices[v].position);
      foot_height_.push_back(land_.foot(l, v).z);
      const Vec3 top = face_at(l, v).back();
      tops.push_back(top.xy());
      top_height_.push_back(top.z);
    }
    road_.add_line(feet, true, FixedEdge::Kind::kBorder);
    beside_.add_line(tops, true, FixedEdge::Kind::kBorder);
  }
  for (std::size_t l = 0; l < land_.outline().loops.size(); ++l) plan_rows(l);
}

// Lines beside the outline where the section has a corner, as far as they are not nearer to another stretch.
void Mesher::plan_rows(std::size_t loop) {
  constexpr double kSlack = 0.01;
  const OutlineLoop& line = land_.outline().loops[loop];
  const std::size_t n = line.vertices.size();
  for (std::size_t corner = 1; corner < 5; ++corner) {
    std::vector<Vec2> row;
    for (std::size_t i = 0; i <= n; ++i) {
      const std::size_t v = i % n;
      const std::vector<Vec2> profile = profile_of(land_.section(loop, v));
      const Vec2 outward = outward_at(line, v);
      const double away = corner < profile.size() ? profile[corner].x : 0.0;
      const Vec2 p = line.vertices[v].position + (away / norm(outward)) * outward;
      if (away > 0.0 && land_.index().nearest(p).outside_m >= (1.0 - kSlack) * away) {
        row.push_back(p);
        if (i < n) continue;
      }
      beside_.add_line(row, false, FixedEdge::Kind::kCrease);
      row.clear();
    }
  }
}

// The centre lines, where the crown breaks.
void Mesher::plan_creases() {
  constexpr double kStep_m = 1.0;
  if (land_.ground().config().crown == 0.0) return;
  for (std::size_t i = 0; i < land_.roads().size(); ++i) {
    const Road& road = land_.roads()[i];
    std::vector<double> stations = road.line().joints();
    for (double s = kStep_m; s < road.length_m(); s += kStep_m) stations.push_back(s);
    for (const Mouth& mouth : land_.outline().mouths) {
      if (mouth.road == i) stations.push_back(land_.roads()[mouth.branch].config().at_m);
    }
    std::sort(stations.begin(), stations.end());
    std::vector<Vec2> line;
    for (const double s : stations) line.push_back(road.line().point(s, 0.0));
    road_.add_line(line, false, FixedEdge::Kind::kCrease);
  }
}

void Mesher::plan_crowns() {
  if (land_.ground().config().crown == 0.0) return;
  for (const Mouth& mouth : land_.outline().mouths) {
    const double reach = distance(mouth.begin, mouth.end);
    const Vec2 center = land_.roads()[mouth.branch].line().at(0.0).position;
    visit_lattice(around(center, reach), kCrownStep_m, 0.0, [&](Vec2 p) {
      if (land_.index().nearest(p).outside_m < -0.4 * kCrownStep_m) road_.points.push_back(p);
    });
  }
}

void Mesher::add_lattice_point(Vec2 p, double step, double reach) {
  const double outside = land_.index().nearest(p).outside_m;
  if (outside < -0.4 * step) {
    road_.points.push_back(p);
  } else if (outside > 0.4 * step + 0.3 && outside < reach) {
    beside_.points.push_back(p);
  }
}

void Mesher::plan_bumps() {
  const double step = fine_step(land_.ground().config());
  if (step == 0.0) return;
  visit_lattice(box_, step, kFineReach_m, [&](Vec2 p) { add_lattice_point(p, step, kFineReach_m); });
}

void Mesher::plan_grass() {
  if (land_.ground().config().grass_m == 0.0) return;
  visit_lattice(box_, kGrassStep_m, kGrassReach_m, [&](Vec2 p) {
    const NearestEdge near = land_.index().nearest(p);
    const OutlineVertex& v = land_.outline().loops[near.loop].vertices[near.vertex];
    const bool grass = v.part != Part::kEnd && (v.edge == Edge::kGrass || v.edge == Edge::kDitch);
    if (grass && near.outside_m > 0.1 && near.outside_m < kGrassReach_m) beside_.points.push_back(p);
  });
}

void Mesher::plan_slopes() {
  if (land_.ground().is_plane()) return;
  visit_lattice(box_, kCoarse_m, kCoarseReach_m,
                [&](Vec2 p) { add_lattice_point(p, kCoarse_m, kCoarseReach_m); });
}

void Mesher::add_triangles(const std::vector<std::array<std::uint32_t, 3>>& triangles, std::uint32_t first,
                           bool road) {
  for (const auto& t : triangles) {
    world_.triangles.push_back({first + t[0], first + t[1], first + t[2]});
    const Vec3 sum =
        world_.vertices[first + t[0]] + world_.vertices[first + t[1]] + world_.vertices[first + t[2]];
    world_.surface.push_back(road ? Surface::kRoad : land_.surface((1.0 / 3.0) * sum.xy()));
  }
}

void Mesher::add_road() {
  const Triangulation net = triangulate(road_.points, road_.edges, 1.0);
  const auto first = static_cast<std::uint32_t>(world_.vertices.size());
  for (std::size_t i = 0; i < net.points.size(); ++i) {
    const Vec2 p = net.points[i];
    const double height = i < foot_height_.size() ? foot_height_[i] : land_.ground().road(p);
    world_.vertices.push_back({p.x, p.y, height});
  }
  add_triangles(net.inside, first, true);
}

void Mesher::add_beside() {
  const Triangulation net = triangulate(beside_.points, beside_.edges, kMargin_m);
  const auto first = static_cast<std::uint32_t>(world_.vertices.size());
  for (std::size_t i = 0; i < net.points.size(); ++i) {
    const Vec2 p = net.points[i];
    world_.vertices.push_back({p.x, p.y, i < top_height_.size() ? top_height_[i] : land_.height(p)});
  }
  add_triangles(net.outside, first, false);
}

// From one section of the face to the next; where one has no step, its corners lie on its foot.
void Mesher::add_face(std::size_t loop, std::size_t vertex) {
  const OutlineLoop& line = land_.outline().loops[loop];
  std::vector<Vec3> a = face_at(loop, vertex);
  std::vector<Vec3> b = face_at(loop, (vertex + 1) % line.vertices.size());
  const std::size_t corners = std::max(a.size(), b.size());
  a.resize(corners, a.back());
  b.resize(corners, b.back());
  const Surface surface = line.vertices[vertex].edge == Edge::kWall ? Surface::kWall : Surface::kCurb;
  for (std::size_t i = 0; i + 1 < corners; ++i) {
    if (norm(a[i + 1] - a[i]) > 0.0) add_triangle(world_, a[i], b[i], a[i + 1], surface);
    if (norm(b[i + 1] - b[i]) > 0.0) add_triangle(world_, b[i], b[i + 1], a[i + 1], surface);
  }
}

void Mesher::add_faces() {
  for (std::size_t l = 0; l < land_.outline().loops.size(); ++l) {
    for (std::size_t v = 0; v < land_.outline().loops[l].vertices.size(); ++v) add_face(l, v);
  }
}

}  // namespace

double outline_step(const GroundConfig& ground) {
  const double fine = fine_step(ground);
  return fine > 0.0 ? std::min(fine, kLongestStep_m) : kLongestStep_m;
}

World mesh_of(const Land& land) { return Mesher(land).make(); }

}  // namespace verge::sim
