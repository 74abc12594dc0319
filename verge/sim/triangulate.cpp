// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/sim/triangulate.hpp"

#include <algorithm>
#include <cmath>
#include <deque>
#include <limits>
#include <numeric>
#include <optional>
#include <stdexcept>

#include <fmt/format.h>

namespace verge::sim {
namespace {

__extension__ using Wide = __int128;

constexpr double kGrid_m = 0x1p-18;                       // 3.8 um
constexpr std::int64_t kWidest = std::int64_t{1} << 30U;  // products of four differences fit in 127 bits
constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

struct Cell {  // a point in whole numbers of the grid
  std::int64_t x = 0;
  std::int64_t y = 0;
  friend bool operator==(const Cell&, const Cell&) = default;
};

// Twice the area of a, b, c: positive where they turn left.
std::int64_t turn(Cell a, Cell b, Cell c) { return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x); }

// Whether d lies within the circle through a, b, c (which turn left).
bool in_circle(Cell a, Cell b, Cell c, Cell d) {
  const auto lift = [&](Cell p) { return (p.x - d.x) * (p.x - d.x) + (p.y - d.y) * (p.y - d.y); };
  const auto minor = [&](Cell p, Cell q) { return (p.x - d.x) * (q.y - d.y) - (p.y - d.y) * (q.x - d.x); };
  return Wide{lift(a)} * minor(b, c) + Wide{lift(b)} * minor(c, a) + Wide{lift(c)} * minor(a, b) > 0;
}

enum class Fix : std::uint8_t { kFree, kCrease, kBorder };

struct Triangle {
  std::array<std::uint32_t, 3> corner{kNone, kNone, kNone};  // counter-clockwise
  std::array<std::uint32_t, 3> beyond{kNone, kNone, kNone};  // the triangle across the edge opposite corner i
  std::array<Fix, 3> fix{Fix::kFree, Fix::kFree, Fix::kFree};  // of that edge
};

struct EdgeOf {  // the edge of triangle t opposite its corner i
  std::uint32_t t = kNone;
  unsigned i = 0;
};

constexpr unsigned next(unsigned i) { return (i + 1U) % 3U; }
constexpr unsigned previous(unsigned i) { return (i + 2U) % 3U; }

/// The triangles while they grow.
class Net {
 public:
  Net(std::span<const Vec2> points, double margin_m);

  void insert_all();
  void fix(const FixedEdge& edge);
  [[nodiscard]] Triangulation result() const;

 private:
  [[nodiscard]] unsigned index_of(std::uint32_t t, std::uint32_t corner) const;
  [[nodiscard]] unsigned index_beyond(std::uint32_t t, std::uint32_t other) const;
  [[nodiscard]] EdgeOf across(EdgeOf e) const;
  [[nodiscard]] std::optional<EdgeOf> edge_between(std::uint32_t a, std::uint32_t b) const;
  [[nodiscard]] std::vector<std::uint32_t> around(std::uint32_t corner) const;
  [[nodiscard]] std::uint32_t locate(Cell p) const;
  void set_beyond(std::uint32_t t, unsigned i, std::uint32_t other, Fix fix);
  void connect(std::uint32_t a, unsigned i, std::uint32_t b, unsigned j, Fix fix);
  void insert(std::uint32_t p);
  void split_triangle(std::uint32_t t, std::uint32_t p);
  void split_edge(EdgeOf e, std::uint32_t p);
  void flip(EdgeOf e);
  void make_delaunay(std::vector<EdgeOf> pending);
  [[nodiscard]] bool convex(EdgeOf e) const;
  [[nodiscard]] bool crosses(std::uint32_t a, std::uint32_t b, std::uint32_t u, std::uint32_t v) const;
  /// What a fixed edge from a to b meets: the edges that it crosses, and the first corner that it comes to.
  struct Path {
    std::vector<std::pair<std::uint32_t, std::uint32_t>> crossed;
    std::uint32_t end = kNone;
    bool meets_border = false;
    bool meets_fixed = false;
  };
  [[nodiscard]] Path path(std::uint32_t a, std::uint32_t b) const;
  void clear_way(std::uint32_t a, const Path& way);
  void mark(std::uint32_t a, std::uint32_t b, Fix fix);
  [[noreturn]] void refuse(std::uint32_t a, std::uint32_t b) const;

  std::vector<Vec2> points_;
  std::vector<Cell> cells_;
  std::vector<std::uint32_t> same_;   // the point that stands for this one
  std::vector<std::uint32_t> first_;  // one triangle at each point
  std::vector<Triangle> triangles_;
  mutable std::uint32_t near_ = 0;  // where the last point was found
};

Net::Net(std::span<const Vec2> points, double margin_m) : points_(points.begin(), points.end()) {
  Vec2 low{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  Vec2 high = -1.0 * low;
  for (const Vec2 p : points_) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y)};
  }
  if (points_.empty()) low = high = {};
  const Vec2 center = 0.5 * (low + high);
  const double half = 0.5 * std::max(high.x - low.x, high.y - low.y) + std::max(1.0, margin_m);
  if (!(2.0 * half < kGrid_m * static_cast<double>(kWidest))) {
    throw std::invalid_argument("the world is wider than 4 km");
  }
  for (const auto& [x, y] : {std::pair{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}) {
    points_.push_back(center + half * Vec2{static_cast<double>(x), static_cast<double>(y)});
  }
  for (const Vec2 p : points_) {
    cells_.push_back({std::llround((p.x - center.x) / kGrid_m), std::llround((p.y - center.y) / kGrid_m)});
  }
  same_.resize(points_.size());
  std::iota(same_.begin(), same_.end(), 0U);
  first_.assign(points_.size(), kNone);
  const auto n = static_cast<std::uint32_t>(points.size());
  triangles_.push_back({{n, n + 1, n + 2}, {}, {}});
  triangles_.push_back({{n, n + 2, n + 3}, {}, {}});
  triangles_[0].beyond = {kNone, 1, kNone};
  triangles_[1].beyond = {kNone, kNone, 0};
  first_[n] = first_[n + 1] = first_[n + 2] = 0;
  first_[n + 3] = 1;
}

unsigned Net::index_of(std::uint32_t t, std::uint32_t corner) const {
  const auto& c = triangles_[t].corner;
  return static_cast<unsigned>(std::find(c.begin(), c.end(), corner) - c.begin());
}

unsigned Net::index_beyond(std::uint32_t t, std::uint32_t other) const {
  const auto& b = triangles_[t].beyond;
  return static_cast<unsigned>(std::find(b.begin(), b.end(), other) - b.begin());
}

// The same edge seen from the other side; t = kNone at the frame.
EdgeOf Net::across(EdgeOf e) const {
  const std::uint32_t other = triangles_[e.t].beyond[e.i];
  return other == kNone ? EdgeOf{} : EdgeOf{other, index_beyond(other, e.t)};
}

// The triangles at a corner: once round, or from one frame edge to the other.
std::vector<std::uint32_t> Net::around(std::uint32_t corner) const {
  std::vector<std::uint32_t> fan;
  const std::uint32_t begin = first_[corner];
  std::uint32_t t = begin;
  do {
    fan.push_back(t);
    t = triangles_[t].beyond[next(index_of(t, corner))];
  } while (t != kNone && t != begin);
  if (t == begin) return fan;
  for (t = triangles_[begin].beyond[previous(index_of(begin, corner))]; t != kNone;
       t = triangles_[t].beyond[previous(index_of(t, corner))]) {
    fan.push_back(t);
  }
  return fan;
}

std::optional<EdgeOf> Net::edge_between(std::uint32_t a, std::uint32_t b) const {
  for (const std::uint32_t t : around(a)) {
    const unsigned i = index_of(t, a);
    if (triangles_[t].corner[next(i)] == b) return EdgeOf{t, previous(i)};
    if (triangles_[t].corner[previous(i)] == b) return EdgeOf{t, next(i)};
  }
  return std::nullopt;
}

// A triangle that holds p, on its edges at least: walks toward it from where the last point was found.
std::uint32_t Net::locate(Cell p) const {
  std::uint32_t t = near_;
  for (unsigned i = 0; i < 3;) {
    const Triangle& here = triangles_[t];
    const bool right = turn(cells_[here.corner[next(i)]], cells_[here.corner[previous(i)]], p) < 0;
    if (!right) {
      ++i;
      continue;
    }
    t = here.beyond[i];
    i = 0;
  }
  near_ = t;
  return t;
}

void Net::set_beyond(std::uint32_t t, unsigned i, std::uint32_t other, Fix fix) {
  triangles_[t].beyond[i] = other;
  triangles_[t].fix[i] = fix;
}

void Net::connect(std::uint32_t a, unsigned i, std::uint32_t b, unsigned j, Fix fix) {
  set_beyond(a, i, b, fix);
  if (b != kNone) set_beyond(b, j, a, fix);
}

void Net::split_triangle(std::uint32_t t, std::uint32_t p) {
  const Triangle old = triangles_[t];
  const auto b = static_cast<std::uint32_t>(triangles_.size());
  const std::uint32_t c = b + 1;
  std::array<EdgeOf, 3> outer;
  for (unsigned i = 0; i < 3; ++i) outer[i] = across({t, i});
  triangles_.resize(triangles_.size() + 2);
  const std::array<std::uint32_t, 3> part = {t, b, c};  // part i keeps edge i and has p instead of corner i
  for (unsigned i = 0; i < 3; ++i) {
    triangles_[part[i]].corner = old.corner;
    triangles_[part[i]].corner[i] = p;
    connect(part[i], i, outer[i].t, outer[i].i, old.fix[i]);
  }
  for (unsigned i = 0; i < 3; ++i) connect(part[i], next(i), part[next(i)], i, Fix::kFree);
  for (unsigned i = 0; i < 3; ++i) first_[old.corner[i]] = part[next(i)];
  first_[p] = t;
  make_delaunay({{part[0], 0}, {part[1], 1}, {part[2], 2}});
}

void Net::split_edge(EdgeOf e, std::uint32_t p) {
  const EdgeOf f = across(e);
  const Fix fix = triangles_[e.t].fix[e.i];
  // On each side of the edge u-v one triangle (w, u, v) becomes (w, u, p), in its place, and (w, p, v).
  const auto half = [&](EdgeOf side) {
    const Triangle old = triangles_[side.t];
    const EdgeOf outer = across({side.t, next(side.i)});  // beyond v-w
    const auto fresh = static_cast<std::uint32_t>(triangles_.size());
    triangles_.push_back(old);
    triangles_[side.t].corner[previous(side.i)] = p;
    triangles_[fresh].corner[next(side.i)] = p;
    connect(fresh, next(side.i), outer.t, outer.i, old.fix[next(side.i)]);
    connect(side.t, next(side.i), fresh, previous(side.i), Fix::kFree);
    first_[old.corner[previous(side.i)]] = fresh;
    first_[old.corner[next(side.i)]] = side.t;
    first_[old.corner[side.i]] = side.t;
    return fresh;
  };
  const std::uint32_t g = half(e);
  first_[p] = e.t;
  std::vector<EdgeOf> pending = {{e.t, previous(e.i)}, {g, next(e.i)}};
  if (f.t == kNone) {
    set_beyond(e.t, e.i, kNone, fix);
    set_beyond(g, e.i, kNone, fix);
  } else {
    const std::uint32_t h = half(f);
    connect(e.t, e.i, h, f.i, fix);  // u-p: u is first on this side and last on the other
    connect(g, e.i, f.t, f.i, fix);
    pending.insert(pending.end(), {{f.t, previous(f.i)}, {h, next(f.i)}});
  }
  make_delaunay(std::move(pending));
}

// Turns the edge between two triangles into the other diagonal of their quadrilateral.
void Net::flip(EdgeOf e) {
  const EdgeOf f = across(e);
  const std::uint32_t a = triangles_[e.t].corner[e.i];
  const std::uint32_t b = triangles_[e.t].corner[next(e.i)];
  const std::uint32_t d = triangles_[f.t].corner[f.i];
  const std::uint32_t c = triangles_[e.t].corner[previous(e.i)];
  const EdgeOf bd = across({f.t, next(f.i)});  // opposite the corner of f after d, which is c
  const EdgeOf ca = across({e.t, next(e.i)});
  const Fix fix_bd = triangles_[f.t].fix[next(f.i)];
  const Fix fix_ca = triangles_[e.t].fix[next(e.i)];
  triangles_[e.t].corner[previous(e.i)] = d;  // a b d
  triangles_[f.t].corner[previous(f.i)] = a;  // d c a
  connect(e.t, e.i, bd.t, bd.i, fix_bd);
  connect(f.t, f.i, ca.t, ca.i, fix_ca);
  connect(e.t, next(e.i), f.t, next(f.i), Fix::kFree);
  first_[a] = first_[b] = first_[d] = e.t;
  first_[c] = f.t;
}

void Net::make_delaunay(std::vector<EdgeOf> pending) {
  while (!pending.empty()) {
    const EdgeOf e = pending.back();
    pending.pop_back();
    const EdgeOf f = across(e);
    if (f.t == kNone || triangles_[e.t].fix[e.i] != Fix::kFree) continue;
    const auto& corner = triangles_[e.t].corner;
    if (!in_circle(cells_[corner[0]], cells_[corner[1]], cells_[corner[2]],
                   cells_[triangles_[f.t].corner[f.i]])) {
      continue;
    }
    flip(e);
    // The new point is corner e.i of e.t and the one before the corner f.i of f.t: the far edges are next.
    pending.push_back({e.t, e.i});
    pending.push_back({f.t, previous(f.i)});
  }
}

void Net::insert(std::uint32_t p) {
  const std::uint32_t t = locate(cells_[p]);
  const Triangle& here = triangles_[t];
  for (unsigned i = 0; i < 3; ++i) {
    if (cells_[here.corner[i]] != cells_[p]) continue;
    same_[p] = here.corner[i];
    return;
  }
  for (unsigned i = 0; i < 3; ++i) {
    if (turn(cells_[here.corner[next(i)]], cells_[here.corner[previous(i)]], cells_[p]) != 0) continue;
    split_edge({t, i}, p);
    return;
  }
  split_triangle(t, p);
}

// Strip by strip, there and back, so that each point lies near the one before.
void Net::insert_all() {
  const std::size_t count = points_.size() - 4;
  const std::int64_t width = cells_[count + 1].x - cells_[count].x;
  const auto strips = static_cast<std::int64_t>(std::sqrt(static_cast<double>(count) / 2.0)) + 1;
  const auto strip_of = [&](std::uint32_t p) {
    return (cells_[p].x - cells_[count].x) / (width / strips + 1);
  };
  std::vector<std::uint32_t> order(count);
  std::iota(order.begin(), order.end(), 0U);
  std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    const std::int64_t sa = strip_of(a);
    const std::int64_t sb = strip_of(b);
    if (sa != sb) return sa < sb;
    return sa % 2 == 0 ? cells_[a].y < cells_[b].y : cells_[a].y > cells_[b].y;
  });
  for (const std::uint32_t p : order) insert(p);
}

bool Net::crosses(std::uint32_t a, std::uint32_t b, std::uint32_t u, std::uint32_t v) const {
  if (u == a || u == b || v == a || v == b) return false;
  const std::int64_t tu = turn(cells_[a], cells_[b], cells_[u]);
  const std::int64_t tv = turn(cells_[a], cells_[b], cells_[v]);
  return (tu < 0 && tv > 0) || (tu > 0 && tv < 0);
}

bool Net::convex(EdgeOf e) const {
  const EdgeOf f = across(e);
  const Cell a = cells_[triangles_[e.t].corner[e.i]];
  const Cell b = cells_[triangles_[e.t].corner[next(e.i)]];
  const Cell c = cells_[triangles_[e.t].corner[previous(e.i)]];
  const Cell d = cells_[triangles_[f.t].corner[f.i]];
  return turn(a, b, d) > 0 && turn(d, c, a) > 0;
}

Net::Path Net::path(std::uint32_t a, std::uint32_t b) const {
  Path way;
  EdgeOf at;
  for (const std::uint32_t t : around(a)) {
    const unsigned i = index_of(t, a);
    const std::uint32_t u = triangles_[t].corner[next(i)];
    const std::uint32_t v = triangles_[t].corner[previous(i)];
    const std::int64_t tu = turn(cells_[a], cells_[b], cells_[u]);
    const std::int64_t tv = turn(cells_[a], cells_[b], cells_[v]);
    const auto ahead = [&](std::uint32_t p) {
      return (cells_[p].x - cells_[a].x) * (cells_[b].x - cells_[a].x) +
                 (cells_[p].y - cells_[a].y) * (cells_[b].y - cells_[a].y) >
             0;
    };
    if (tu == 0 && ahead(u)) return {{}, u, false, false};
    if (tv == 0 && ahead(v)) return {{}, v, false, false};
    if (tu < 0 && tv > 0) at = {t, i};
  }
  while (at.t != kNone) {
    const Triangle& here = triangles_[at.t];
    way.meets_border = way.meets_border || here.fix[at.i] == Fix::kBorder;
    way.meets_fixed = way.meets_fixed || here.fix[at.i] != Fix::kFree;
    way.crossed.emplace_back(here.corner[next(at.i)], here.corner[previous(at.i)]);
    const EdgeOf other = across(at);
    const std::uint32_t far = triangles_[other.t].corner[other.i];
    const std::int64_t side = turn(cells_[a], cells_[b], cells_[far]);
    if (far == b || side == 0) {
      way.end = far;
      break;
    }
    // Leaves through the edge whose ends lie on both sides.
    at = {other.t, side < 0 ? previous(other.i) : next(other.i)};
    const Triangle& there = triangles_[other.t];
    if (!crosses(a, b, there.corner[next(at.i)], there.corner[previous(at.i)])) {
      at.i = at.i == next(other.i) ? previous(other.i) : next(other.i);
    }
  }
  return way;
}

// Flips the crossed edges until none is left.
void Net::clear_way(std::uint32_t a, const Path& way) {
  std::deque<std::pair<std::uint32_t, std::uint32_t>> pending(way.crossed.begin(), way.crossed.end());
  while (!pending.empty()) {
    const auto [u, v] = pending.front();
    pending.pop_front();
    const EdgeOf e = *edge_between(u, v);
    if (!convex(e)) {
      pending.emplace_back(u, v);
      continue;
    }
    const std::uint32_t p = triangles_[e.t].corner[e.i];
    const EdgeOf f = across(e);
    const std::uint32_t q = triangles_[f.t].corner[f.i];
    flip(e);
    if (crosses(a, way.end, p, q)) pending.emplace_back(p, q);
  }
}

void Net::mark(std::uint32_t a, std::uint32_t b, Fix fix) {
  const EdgeOf e = *edge_between(a, b);
  const Fix stronger = std::max(fix, triangles_[e.t].fix[e.i]);
  triangles_[e.t].fix[e.i] = stronger;
  const EdgeOf f = across(e);
  if (f.t != kNone) triangles_[f.t].fix[f.i] = stronger;
}

void Net::refuse(std::uint32_t a, std::uint32_t b) const {
  throw std::invalid_argument(fmt::format("borders cross between ({:.2f}, {:.2f}) and ({:.2f}, {:.2f})",
                                          points_[a].x, points_[a].y, points_[b].x, points_[b].y));
}

void Net::fix(const FixedEdge& edge) {
  std::uint32_t a = same_[edge.from];
  const std::uint32_t b = same_[edge.to];
  const bool border = edge.kind == FixedEdge::Kind::kBorder;
  while (a != b) {
    const Path way = path(a, b);
    if (way.meets_fixed && border) refuse(a, b);
    if (way.meets_fixed) return;
    clear_way(a, way);
    mark(a, way.end, border ? Fix::kBorder : Fix::kCrease);
    a = way.end;
  }
}

// Inside and outside change at every border, counted from the frame.
Triangulation Net::result() const {
  Triangulation out;
  out.points = points_;
  std::vector<std::int8_t> inside(triangles_.size(), -1);
  std::deque<std::uint32_t> pending = {first_[points_.size() - 4]};
  inside[pending.front()] = 0;
  while (!pending.empty()) {
    const std::uint32_t t = pending.front();
    pending.pop_front();
    for (unsigned i = 0; i < 3; ++i) {
      const std::uint32_t other = triangles_[t].beyond[i];
      if (other == kNone || inside[other] >= 0) continue;
      const bool border = triangles_[t].fix[i] == Fix::kBorder;
      inside[other] = static_cast<std::int8_t>(border ? 1 - inside[t] : inside[t]);
      pending.push_back(other);
    }
  }
  for (std::size_t t = 0; t < triangles_.size(); ++t) {
    (inside[t] == 1 ? out.inside : out.outside).push_back(triangles_[t].corner);
  }
  return out;
}

}  // namespace

Triangulation triangulate(std::span<const Vec2> points, std::span<const FixedEdge> edges, double margin_m) {
  Net net(points, margin_m);
  net.insert_all();
  for (const FixedEdge& edge : edges) {
    if (edge.kind == FixedEdge::Kind::kBorder) net.fix(edge);
  }
  for (const FixedEdge& edge : edges) {
    if (edge.kind == FixedEdge::Kind::kCrease) net.fix(edge);
  }
  return net.result();
}

}  // namespace verge::sim
