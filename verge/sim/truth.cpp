// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/sim/truth.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <numbers>
#include <utility>

#include "verge/core/angle.hpp"

namespace verge::sim {
namespace {

constexpr double kStep_m = 0.1;
constexpr double kLowestKerb_m = 0.03;

BoundaryKind kind_of(Edge edge, double step_m) {
  switch (edge) {
    case Edge::kGrass:
    case Edge::kDitch:
      return BoundaryKind::kVerge;
    case Edge::kWall:
      return BoundaryKind::kWall;
    case Edge::kKerb:
    case Edge::kFlush:
      break;
  }
  return step_m >= kLowestKerb_m ? BoundaryKind::kCurb : BoundaryKind::kFlush;
}

bool is_straight(const std::vector<Vec3>& line) {
  constexpr double kTolerance_m = 1e-6;
  const Vec2 chord = (line.back() - line.front()).xy();
  return std::all_of(line.begin(), line.end(), [&](const Vec3& p) {
    return std::fabs(cross(chord, (p - line.front()).xy())) <= kTolerance_m * norm(chord);
  });
}

double signed_area(const OutlineLoop& loop) {
  double twice = 0.0;
  for (std::size_t i = 0; i < loop.vertices.size(); ++i) {
    twice += cross(loop.vertices[i].position, loop.vertices[(i + 1) % loop.vertices.size()].position);
  }
  return 0.5 * twice;
}

ObjectClass class_of(Thing thing) {
  switch (thing) {
    case Thing::kCar:
      return ObjectClass::kCar;
    case Thing::kVan:
      return ObjectClass::kVan;
    case Thing::kTruck:
    case Thing::kTrailer:
      return ObjectClass::kTruck;
    case Thing::kCyclist:
      return ObjectClass::kCyclist;
    case Thing::kPerson:
      return ObjectClass::kPerson;
    case Thing::kPole:
      return ObjectClass::kPole;
    default:
      return ObjectClass::kRoadside;
  }
}

// Between parked vehicles, what is narrower looks closed to every scanner, and what is wider is no gap.
constexpr double kParkedGapMin_m = 1.0;
constexpr double kParkedGapMax_m = 8.0;

Vec2 in_sensor(const Pose& T_sensor_world, Vec3 p) { return (T_sensor_world * p).xy(); }

// The middle of a closed road.
Vec2 ring_center(const Road& road) {
  constexpr int kPlaces = 64;
  Vec2 sum;
  for (int i = 0; i < kPlaces; ++i) sum = sum + road.line().at(road.length_m() * i / kPlaces).position;
  return (1.0 / kPlaces) * sum;
}

// Direction in the sensor frame of a heading in the world.
double turned(const Pose& T_sensor_world, double heading_rad) {
  const Vec3 d = rotate(T_sensor_world.rotation, {std::cos(heading_rad), std::sin(heading_rad), 0.0});
  return std::atan2(d.y, d.x);
}

void finish(Boundary& boundary, Vec2 forward) {
  if (dot((boundary.points.back() - boundary.points.front()).xy(), forward) < 0.0) {
    std::reverse(boundary.points.begin(), boundary.points.end());
    std::reverse(boundary.height_m.begin(), boundary.height_m.end());
    std::reverse(boundary.state.begin(), boundary.state.end());
  }
  boundary.model = is_straight(boundary.points) ? Model::kLine : Model::kPolyline;
  boundary.confidence = 1.0;
}

}  // namespace

Truth::Truth(const Land& land, const Furniture& furniture) : land_(land), furniture_(furniture) {
  for (std::size_t l = 0; l < land.outline().loops.size(); ++l) add_loop(l);
}

// The points from a vertex on, without the next one.
void Truth::add_stretch(Chain& chain, std::size_t loop, std::size_t vertex) const {
  const auto& vertices = land_.outline().loops[loop].vertices;
  const std::size_t next = (vertex + 1) % vertices.size();
  const OutlineVertex& from = vertices[vertex];
  const Vec3 a = land_.foot(loop, vertex);
  const Vec3 b = land_.foot(loop, next);
  const int count = std::max(1, static_cast<int>(std::ceil(norm((b - a).xy()) / kStep_m - 1e-9)));
  for (int i = 0; i < count; ++i) {
    const double share = static_cast<double>(i) / count;
    const double step = from.step_m + share * (vertices[next].step_m - from.step_m);
    chain.points.push_back({a + share * (b - a), step, kind_of(from.edge, step)});
  }
  const EdgeName name{from.road, from.side};
  const bool known = std::find(chain.edges.begin(), chain.edges.end(), name) != chain.edges.end();
  if (from.part == Part::kEdge && !known) chain.edges.push_back(name);
}

void Truth::add_loop(std::size_t loop) {
  const auto& vertices = land_.outline().loops[loop].vertices;
  const std::size_t n = vertices.size();
  const auto is_end = [&](std::size_t v) { return vertices[v % n].part == Part::kEnd; };
  std::size_t begin = 0;
  while (begin < n && !is_end(begin)) ++begin;
  const bool open = begin < n;
  const bool hole = signed_area(land_.outline().loops[loop]) < 0.0;
  Chain chain{{}, {}, hole, !open};
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t v = (begin % n + i) % n;
    if (!is_end(v)) {
      add_stretch(chain, loop, v);
      if (open && !is_end(v + 1)) continue;
      if (!open && i + 1 < n) continue;
    }
    if (chain.points.empty()) continue;
    const OutlineVertex& last = vertices[v];
    const std::size_t end = (v + 1) % n;
    const double step = open ? vertices[v].step_m : vertices[end].step_m;
    chain.points.push_back({land_.foot(loop, end), step, kind_of(last.edge, step)});
    chains_.push_back(std::exchange(chain, Chain{{}, {}, hole, !open}));
  }
}

Whereabouts Truth::whereabouts(Vec2 position, double heading_rad, std::size_t road) const {
  constexpr double kLane_m = 2.0;
  Whereabouts best;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < land_.roads().size(); ++i) {
    const Road& r = land_.roads()[i];
    const Beside beside = r.line().nearest(position);
    const double along_road = std::cos(heading_rad - r.line().at(beside.station_m).heading_rad);
    const bool near = std::fabs(beside.lateral_m) < r.half_width(beside.station_m) + kLane_m;
    double cost = std::fabs(beside.lateral_m);
    if (std::fabs(along_road) < 0.7) cost += 1e3;
    if (i == road && near && std::fabs(along_road) >= 0.7) cost = -1.0;
    if (cost >= least) continue;
    least = cost;
    best = {i, beside.station_m, along_road < 0.0 ? -1.0 : 1.0};
  }
  return best;
}

Side Truth::side_of(const Chain& chain, const Whereabouts& where) const {
  const auto holds = [&](RoadSide side) {
    const EdgeName name{where.road, side};
    return std::find(chain.edges.begin(), chain.edges.end(), name) != chain.edges.end();
  };
  const bool along_road = where.direction > 0.0;
  if (holds(RoadSide::kLeft)) return along_road ? Side::kLeft : Side::kRight;
  if (holds(RoadSide::kRight)) return along_road ? Side::kRight : Side::kLeft;
  return chain.hole ? Side::kIsland : Side::kOther;
}

void Truth::add_boundaries(const Chain& chain, const TruthView& view, const Whereabouts& where,
                           Scene& scene) const {
  constexpr Vec3 kAboveFoot = {0.0, 0.0, 0.02};
  constexpr double kBlockMargin_m = 0.05;
  const Pose T_sensor_world = inverse(view.T_world_sensor);
  const Vec2 eye = view.T_world_sensor.translation.xy();
  const double forward = turned(T_sensor_world, view.heading_rad);
  const Side side = side_of(chain, where);
  Boundary run;
  const auto close_run = [&] {
    if (run.points.size() >= 2) {
      finish(run, {std::cos(forward), std::sin(forward)});
      run.side = side;
      scene.boundaries.push_back(run);
    }
    run = Boundary{};
  };
  const auto is_inside = [&](const Point& point) {
    return distance(point.foot.xy(), eye) <= view.radius_m &&
           norm((T_sensor_world * point.foot).xy()) <= view.radius_m;
  };
  // A closed chain is begun outside the circle, so that it is not cut where it happens to begin.
  const auto outside = std::find_if_not(chain.points.begin(), chain.points.end(), is_inside);
  const auto first = static_cast<std::size_t>(outside - chain.points.begin());
  const std::size_t shift = chain.closed && outside != chain.points.end() ? first : 0;
  for (std::size_t i = 0; i < chain.points.size(); ++i) {
    const Point& point = chain.points[(shift + i) % chain.points.size()];
    if (chain.closed && shift > 0 && (shift + i) % chain.points.size() == 0)
      continue;  // stands at its end too
    if (!is_inside(point)) {
      close_run();
      continue;
    }
    const bool hidden =
        view.world.blocked(view.T_world_sensor.translation, point.foot + kAboveFoot, kBlockMargin_m);
    const auto put = [&] {
      run.kind = point.kind;
      run.points.push_back(T_sensor_world * point.foot);
      run.height_m.push_back(point.step_m);
      run.state.push_back(hidden ? PointState::kOccluded : PointState::kVisible);
    };
    const bool changes = !run.points.empty() && run.kind != point.kind;
    if (changes) close_run();
    put();
  }
  close_run();
}

void Truth::add_openings(const TruthView& view, Scene& scene) const {
  const Pose T_sensor_world = inverse(view.T_world_sensor);
  const auto add = [&](Vec2 begin, Vec2 end) {
    std::array<Vec2, 2> ends = {};
    for (std::size_t i = 0; i < 2; ++i) {
      const Vec2 p = i == 0 ? begin : end;
      ends.at(i) = in_sensor(T_sensor_world, {p.x, p.y, land_.ground().road(p)});
    }
    if (norm(ends[1]) < norm(ends[0])) std::swap(ends[0], ends[1]);
    if (norm(ends[0]) <= view.radius_m) scene.openings.push_back({ends, distance(begin, end), 1.0});
  };
  for (const Mouth& mouth : land_.outline().mouths) add(mouth.begin, mouth.end);
  for (const Road& road : land_.roads()) {
    for (const Gap& gap : road.config().gaps) {
      if (gap.height_m >= kLowestKerb_m || road.edge(gap.side) != Edge::kKerb) continue;
      const double half = 0.5 * gap.width_m;
      add(road.edge_point(gap.side, gap.at_m - half).position,
          road.edge_point(gap.side, gap.at_m + half).position);
    }
  }
}

void Truth::add_corner(const TruthView& view, const Whereabouts& where, const Opened& opened,
                       Scene& scene) const {
  const Pose T_sensor_world = inverse(view.T_world_sensor);
  const bool along_road = where.direction > 0.0;
  const double near = along_road ? opened.begin_m : opened.end_m;
  const double far = along_road ? opened.end_m : opened.begin_m;
  const double to_near = where.direction * (near - where.station_m);
  const double to_far = where.direction * (far - where.station_m);
  if (to_far < 0.0 || to_near > view.radius_m) return;
  const Vec2 p = along_road ? opened.begin : opened.end;
  Corner corner;
  corner.id = opened.id;
  corner.side = (opened.side == RoadSide::kLeft) == along_road ? CornerSide::kLeft : CornerSide::kRight;
  corner.position = in_sensor(T_sensor_world, {p.x, p.y, land_.ground().road(p)});
  corner.distance_m = to_near;
  corner.width_m = opened.width_m;
  corner.exit_m = to_far;
  corner.confidence = opened.is_road ? 1.0 : 0.0;
  scene.corners.push_back(corner);
}

void Truth::add_corners(const TruthView& view, const Whereabouts& where, Scene& scene) const {
  for (const Mouth& mouth : land_.outline().mouths) {
    const Road& branch = land_.roads()[mouth.branch];
    if (mouth.road != where.road) continue;
    add_corner(view, where,
               {.id = static_cast<int>(mouth.branch) + 1,
                .side = mouth.side,
                .begin_m = mouth.begin_m,
                .end_m = mouth.end_m,
                .begin = mouth.begin,
                .end = mouth.end,
                .width_m = 2.0 * branch.half_width(mouth.begin_branch_m),
                .is_road = !branch.config().driveway},
               scene);
  }
  add_false_corners(view, where, scene);
}

// Gaps of the kerb, and those between parked vehicles, of the vehicle's road.
void Truth::add_false_corners(const TruthView& view, const Whereabouts& where, Scene& scene) const {
  constexpr int kFirstGapId = 10'000;
  constexpr int kFirstParkedId = 20'000;
  const Road& road = land_.roads()[where.road];
  const auto add = [&](int id, RoadSide side, const Parked& before, const Parked& behind) {
    add_corner(view, where,
               {.id = id,
                .side = side,
                .begin_m = before.end_m,
                .end_m = behind.begin_m,
                .begin = road.line().point(before.end_m, before.lateral_m),
                .end = road.line().point(behind.begin_m, behind.lateral_m),
                .width_m = behind.begin_m - before.end_m,
                .is_road = false},
               scene);
  };
  int id = kFirstGapId;
  for (const Gap& gap : road.config().gaps) {
    ++id;
    if (gap.height_m >= kLowestKerb_m || road.edge(gap.side) != Edge::kKerb) continue;
    const double begin_m = gap.at_m - 0.5 * gap.width_m;
    const double end_m = gap.at_m + 0.5 * gap.width_m;
    const double lateral_m = sign_of(gap.side) * road.edge_offset(gap.side, gap.at_m);
    add(id, gap.side, {.end_m = begin_m, .lateral_m = lateral_m}, {.begin_m = end_m, .lateral_m = lateral_m});
  }
  for (const RoadSide side : {RoadSide::kLeft, RoadSide::kRight}) {
    const std::vector<Parked> parked = parked_along(where.road, side);
    for (std::size_t i = 1; i < parked.size(); ++i) {
      const double width_m = parked[i].begin_m - parked[i - 1].end_m;
      if (width_m < kParkedGapMin_m || width_m > kParkedGapMax_m) continue;
      if (in_mouth(land_.outline(), where.road, side, parked[i - 1].end_m, parked[i].begin_m)) continue;
      add(kFirstParkedId + static_cast<int>(parked[i - 1].id), side, parked[i - 1], parked[i]);
    }
  }
}

// Vehicles at rest beside or on an edge of the carriageway, in the order of the road.
std::vector<Truth::Parked> Truth::parked_along(std::size_t road, RoadSide side) const {
  constexpr double kBesideEdge_m = 2.5;  // of their middles
  std::vector<Parked> parked;
  for (const Placed& thing : furniture_.things()) {
    const ObjectClass type = class_of(thing.what);
    const bool is_vehicle =
        type == ObjectClass::kCar || type == ObjectClass::kVan || type == ObjectClass::kTruck;
    if (thing.road != road || !is_vehicle || thing.moves()) continue;
    const double outward = side == RoadSide::kLeft ? thing.item.lateral_m : -thing.item.lateral_m;
    const double from_edge = outward - land_.roads()[road].edge_offset(side, thing.item.at_m);
    if (std::abs(from_edge) > kBesideEdge_m) continue;
    const double half = 0.5 * thing.size.x;
    const double inward_m = thing.item.lateral_m - sign_of(side) * 0.5 * thing.size.y;
    parked.push_back({thing.id, thing.item.at_m - half, thing.item.at_m + half, inward_m});
  }
  std::sort(parked.begin(), parked.end(),
            [](const Parked& a, const Parked& b) { return a.begin_m < b.begin_m; });
  return parked;
}

// Directions in which roads leave a place of a road: along it, against it, and into the branches.
std::vector<double> Truth::ways_from(std::size_t road, double station, const std::vector<Mouth>& mouths,
                                     const Pose& T_sensor_world) const {
  const CenterLine& line = land_.roads()[road].line();
  const double heading = line.at(station).heading_rad;
  std::vector<double> ways;
  const auto add = [&](double world_heading) { ways.push_back(turned(T_sensor_world, world_heading)); };
  if (line.closed() || station < line.length_m() - 1.0) add(heading);
  if (line.closed() || station > 1.0) add(heading + std::numbers::pi);
  for (const Mouth& mouth : mouths) add(land_.roads()[mouth.branch].line().at(0.0).heading_rad);
  std::sort(ways.begin(), ways.end());
  return ways;
}

void Truth::add_junctions(const TruthView& view, const Whereabouts& where, Scene& scene) const {
  const Pose T_sensor_world = inverse(view.T_world_sensor);
  std::vector<Mouth> pending;
  for (const Mouth& mouth : land_.outline().mouths) {
    const double farthest = where.direction > 0.0 ? mouth.end_m : mouth.begin_m;
    const double nearest = where.direction > 0.0 ? mouth.begin_m : mouth.end_m;
    const bool ahead = where.direction * (farthest - where.station_m) >= 0.0 &&
                       where.direction * (nearest - where.station_m) <= view.radius_m;
    if (mouth.road == where.road && ahead && !land_.roads()[mouth.branch].config().driveway) {
      pending.push_back(mouth);
    }
  }
  std::sort(pending.begin(), pending.end(),
            [](const Mouth& a, const Mouth& b) { return a.begin_m < b.begin_m; });
  // Mouths on both sides whose stretches of the road overlap are one junction.
  for (std::size_t i = 0; i < pending.size(); ++i) {
    std::vector<Mouth> here = {pending[i]};
    if (i + 1 < pending.size() && pending[i + 1].begin_m < pending[i].end_m) here.push_back(pending[++i]);
    double station = 0.0;
    for (const Mouth& mouth : here) station += land_.roads()[mouth.branch].config().at_m;
    station /= static_cast<double>(here.size());
    const Vec2 p = land_.roads()[where.road].line().at(station).position;
    const bool left = (here.front().side == RoadSide::kLeft) == (where.direction > 0.0);
    const JunctionType single = left ? JunctionType::kLeft : JunctionType::kRight;
    scene.junctions.push_back({.type = here.size() > 1 ? JunctionType::kCrossing : single,
                               .center = in_sensor(T_sensor_world, {p.x, p.y, land_.ground().road(p)}),
                               .branches_rad = ways_from(where.road, station, here, T_sensor_world),
                               .confidence = 1.0});
  }
  add_end(view, where, scene);
}

// Where the vehicle's road itself ends within the radius: at the road that it branches off, at a roundabout,
// or without a way on.
void Truth::add_end(const TruthView& view, const Whereabouts& where, Scene& scene) const {
  const Pose T_sensor_world = inverse(view.T_world_sensor);
  const Road& road = land_.roads()[where.road];
  const auto center_of = [&](Vec2 p) {
    return in_sensor(T_sensor_world, {p.x, p.y, land_.ground().road(p)});
  };
  if (where.direction > 0.0) {
    if (!road.config().dead_end || road.length_m() - where.station_m > view.radius_m) return;
    const Station end = road.line().at(road.length_m());
    scene.junctions.push_back({.type = JunctionType::kDeadEnd,
                               .center = center_of(end.position),
                               .branches_rad = {turned(T_sensor_world, end.heading_rad + std::numbers::pi)},
                               .confidence = 1.0});
    return;
  }
  if (road.config().branch_of == 0 || where.station_m > view.radius_m) return;
  const auto& mouths = land_.outline().mouths;
  const auto own =
      std::find_if(mouths.begin(), mouths.end(), [&](const Mouth& m) { return m.branch == where.road; });
  const Road& across = land_.roads()[own->road];
  Corner corner;
  corner.id = static_cast<int>(where.road) + 1;
  corner.side = CornerSide::kBoth;
  const double mouth_m = std::max(own->begin_branch_m, own->end_branch_m);
  corner.position = center_of(road.line().at(mouth_m).position);
  corner.distance_m = where.station_m - mouth_m;
  corner.width_m = 2.0 * across.half_width(road.config().at_m);
  corner.confidence = 1.0;
  scene.corners.push_back(corner);
  const bool round = across.line().closed() && across.length_m() < 200.0;
  const Vec2 p = round ? ring_center(across) : road.line().at(0.0).position;
  std::vector<Mouth> at_ring;
  std::copy_if(mouths.begin(), mouths.end(), std::back_inserter(at_ring), [&](const Mouth& m) {
    return round && m.road == own->road && !land_.roads()[m.branch].config().driveway;
  });
  Junction junction{.type = round ? JunctionType::kRoundabout : JunctionType::kT,
                    .center = center_of(p),
                    .branches_rad = {},
                    .confidence = 1.0};
  if (round) {
    for (const Mouth& m : at_ring) {
      junction.branches_rad.push_back(
          turned(T_sensor_world, land_.roads()[m.branch].line().at(0.0).heading_rad));
    }
    std::sort(junction.branches_rad.begin(), junction.branches_rad.end());
  } else {
    junction.branches_rad = ways_from(own->road, road.config().at_m, {*own}, T_sensor_world);
  }
  scene.junctions.push_back(junction);
}

void Truth::add_objects(const TruthView& view, Scene& scene) const {
  const Pose T_sensor_world = inverse(view.T_world_sensor);
  for (const Placed& thing : furniture_.things()) {
    if (thing.what == Thing::kHouse) continue;
    const Pose T_world_thing = furniture_.pose(thing, view.time_s);
    const Vec3 center = T_sensor_world * (T_world_thing.translation + Vec3{0.0, 0.0, 0.5 * thing.size.z});
    if (norm(center.xy()) > view.radius_m) continue;
    Object object;
    object.id = static_cast<int>(thing.id);
    object.type = class_of(thing.what);
    object.center = center;
    object.size = {thing.size.x, thing.size.y, thing.size.z};
    object.yaw_rad = turned(T_sensor_world, yaw_of(T_world_thing.rotation));
    object.confidence = 1.0;
    scene.objects.push_back(object);
  }
}

void Truth::add_widths(const TruthView& view, const Whereabouts& where, Scene& scene) const {
  constexpr double kWidthStep_m = 5.0;
  const Road& road = land_.roads()[where.road];
  RoadSurface surface;
  for (double ahead = 0.0; ahead <= view.radius_m; ahead += kWidthStep_m) {
    const double station = where.station_m + where.direction * ahead;
    if (!road.line().closed() && (station < 0.0 || station > road.length_m())) break;
    const double width =
        road.edge_offset(RoadSide::kLeft, station) + road.edge_offset(RoadSide::kRight, station);
    surface.width_m.push_back({ahead, width});
  }
  if (!surface.width_m.empty()) scene.road = std::move(surface);
}

Scene Truth::scene(const TruthView& view) const {
  Scene scene;
  scene.method = "truth";
  const Whereabouts where = whereabouts(view.T_world_sensor.translation.xy(), view.heading_rad, view.road);
  if (view.lines) {
    for (const Chain& chain : chains_) add_boundaries(chain, view, where, scene);
  }
  std::stable_sort(scene.boundaries.begin(), scene.boundaries.end(),
                   [](const Boundary& a, const Boundary& b) { return a.side < b.side; });
  for (std::size_t i = 0; i < scene.boundaries.size(); ++i) scene.boundaries[i].id = static_cast<int>(i) + 1;
  if (view.lines) add_openings(view, scene);
  add_corners(view, where, scene);
  add_junctions(view, where, scene);
  add_objects(view, scene);
  add_widths(view, where, scene);
  return scene;
}

}  // namespace verge::sim
