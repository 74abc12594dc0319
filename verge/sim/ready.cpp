// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/sim/ready.hpp"

#include <cmath>
#include <numbers>
#include <stdexcept>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "verge/core/angle.hpp"
#include "verge/core/field_io.hpp"

namespace verge::sim {
namespace {

// --- Parts
// ----------------------------------------------------------------------------------------------------------

RoadConfig straight(double length_m, double width_m = 8.0) {
  RoadConfig road;
  road.width_m = width_m;
  road.pieces = {{length_m}};
  return road;
}

RoadConfig branch(std::int64_t of, double at_m, RoadSide side, double width_m, double radius_m,
                  double length_m = 50.0) {
  RoadConfig road = straight(length_m, width_m);
  road.branch_of = of;
  road.at_m = at_m;
  road.side = side;
  road.radius_m = radius_m;
  return road;
}

RoadConfig driveway(std::int64_t of, double at_m, RoadSide side, double width_m) {
  RoadConfig road = branch(of, at_m, side, width_m, 0.3, 8.0);
  road.driveway = true;
  return road;
}

// A turn with clothoids at both ends: turns by `deg` (positive left) around the radius.
std::vector<Piece> bend(double deg, double radius_m, double clothoid_m) {
  const double curvature = std::copysign(1.0 / radius_m, deg);
  const double arc_m =
      radius_m * std::fabs(deg_to_rad(deg)) - clothoid_m;  // both clothoids turn half of theirs
  return {{clothoid_m, 0.0, curvature}, {arc_m, curvature}, {clothoid_m, curvature, -curvature}};
}

Piece quarter(double radius_m) { return {0.5 * std::numbers::pi * std::fabs(radius_m), 1.0 / radius_m}; }

void append(std::vector<Piece>& pieces, const std::vector<Piece>& more) {
  pieces.insert(pieces.end(), more.begin(), more.end());
}

Row row(Thing what, RoadSide side, double from_m, double to_m, double beside_m, double gap_m = 1.5) {
  return {.what = what, .side = side, .from_m = from_m, .to_m = to_m, .beside_m = beside_m, .gap_m = gap_m};
}

void add_houses(RoadConfig& road) {
  for (const RoadSide side : {RoadSide::kLeft, RoadSide::kRight}) {
    road.rows.push_back(row(Thing::kHouse, side, 0.0, 1e4, road.sidewalk_m + 1.0, 4.0));
  }
}

Scenario on_road(RoadConfig road, double at_m, double lateral_m = 0.0, double speed_mps = 8.0) {
  Scenario scenario;
  scenario.course.at_m = at_m;
  scenario.course.lateral_m = lateral_m;
  scenario.course.speed_mps = speed_mps;
  scenario.roads = {std::move(road)};
  return scenario;
}

// --- Roads
// ----------------------------------------------------------------------------------------------------------

Scenario straight_road() { return on_road(straight(500.0), 100.0); }

// Quarter turns left and right in turn, between straights.
Scenario curved_road() {
  RoadConfig road;
  road.pieces = {{60.0}};
  for (int i = 0; i < 8; ++i) road.pieces.push_back(quarter(i % 2 == 0 ? 30.0 : -30.0));
  road.pieces.push_back({60.0});
  return on_road(road, 60.0 + 0.25 * std::numbers::pi * 30.0);
}

// Straights of 60 m and turns; the vehicle keeps to the right-hand lane.
Scenario street() {
  RoadConfig road;
  road.pieces = {{100.0}};
  for (int i = 0; i < 6; ++i) {
    road.pieces.push_back(quarter(i % 2 == 0 ? 30.0 : -30.0));
    road.pieces.push_back({60.0});
  }
  add_houses(road);
  return on_road(road, 40.0, -2.0);
}

// A loop of 90 m by 60 m with round corners, side roads, parked cars, people, trees and a car that comes
// along.
Scenario campus() {
  RoadConfig loop;
  loop.closed = true;
  loop.width_m = 7.0;
  for (const double side_m : {90.0, 60.0, 90.0, 60.0}) {
    loop.pieces.push_back({side_m});
    append(loop.pieces, bend(90.0, 18.0, 12.0));
  }
  for (const RoadSide side : {RoadSide::kLeft, RoadSide::kRight}) {
    loop.rows.push_back(row(Thing::kTree, side, 125.0, 180.0, 2.5, 12.0));
    loop.rows.push_back(row(Thing::kHouse, side, 0.0, 85.0, 3.5, 5.0));
  }
  loop.rows.push_back(row(Thing::kCar, RoadSide::kRight, 12.0, 32.0, -0.2, 1.2));
  loop.rows.push_back(row(Thing::kCar, RoadSide::kRight, 66.0, 86.0, -0.2, 1.2));
  loop.rows.push_back(row(Thing::kHedge, RoadSide::kRight, 130.0, 180.0, 2.2));
  loop.rows.push_back(row(Thing::kGuardRail, RoadSide::kRight, 222.0, 300.0, 0.4));
  loop.items = {{.what = Thing::kPerson, .at_m = 40.0, .lateral_m = -4.6, .speed_mps = 1.2},
                {.what = Thing::kPerson, .at_m = 60.0, .lateral_m = 4.5, .speed_mps = -1.1},
                {.what = Thing::kCar, .at_m = 95.0, .lateral_m = 1.7, .yaw_deg = 180.0, .speed_mps = -7.0},
                {.what = Thing::kCyclist, .at_m = 30.0, .lateral_m = -1.2, .speed_mps = 4.0},
                {.what = Thing::kBin, .at_m = 52.0, .lateral_m = 4.2}};
  Scenario scenario = on_road(loop, 5.0, -1.7);
  scenario.roads.push_back(branch(1, 52.0, RoadSide::kRight, 5.0, 4.0, 40.0));
  scenario.roads.push_back(driveway(1, 150.0, RoadSide::kRight, 2.5));
  scenario.roads.push_back(branch(1, 250.0, RoadSide::kRight, 6.0, 6.0, 40.0));
  scenario.roads[1].rows = {row(Thing::kHedge, RoadSide::kLeft, 12.0, 40.0, 2.5)};
  return scenario;
}

// --- Junctions
// ------------------------------------------------------------------------------------------------------

Scenario junction(std::vector<RoadSide> sides, double radius_m = 5.0) {
  Scenario scenario = on_road(straight(140.0, 7.0), 40.0, -1.7);
  for (const RoadSide side : sides) scenario.roads.push_back(branch(1, 70.0, side, 6.0, radius_m));
  return scenario;
}

Scenario t_junction() {
  Scenario scenario = junction({RoadSide::kRight});
  scenario.course.road = 2;
  scenario.course.at_m = 45.0;
  scenario.course.against = true;
  scenario.course.lateral_m = 1.5;
  return scenario;
}

// A ring of 14 m with four roads; the vehicle comes in on one of them and leaves on the next but one.
Scenario roundabout() {
  constexpr double kRing_m = 14.0;
  RoadConfig ring;
  ring.closed = true;
  ring.width_m = 7.0;
  ring.x_m = kRing_m;
  ring.heading_deg = 90.0;
  ring.pieces = {{2.0 * std::numbers::pi * kRing_m, 1.0 / kRing_m}};
  Scenario scenario = on_road(ring, 45.0, 1.7, 6.0);
  for (int i = 0; i < 4; ++i) {
    const double at_m = (0.25 * i + 0.125) * 2.0 * std::numbers::pi * kRing_m;
    scenario.roads.push_back(branch(1, at_m, RoadSide::kRight, 6.0, 8.0, 50.0));
  }
  scenario.course.road = 2;
  scenario.course.against = true;
  return scenario;
}

Scenario dead_end() {
  RoadConfig road = straight(100.0, 6.0);
  road.dead_end = true;
  return on_road(road, 40.0);
}

// --- Edges
// ----------------------------------------------------------------------------------------------------------

Scenario kerb(double height_m, KerbFace face = KerbFace::kVertical) {
  RoadConfig road = straight(200.0);
  road.kerb_m = height_m;
  road.face = face;
  return on_road(road, 60.0, -2.0);
}

Scenario edges(Edge edge, double grass_m = 0.0) {
  RoadConfig road = straight(200.0, 7.0);
  road.left = road.right = edge;
  Scenario scenario = on_road(road, 60.0, -1.7);
  scenario.ground.grass_m = grass_m;
  return scenario;
}

Scenario vegetation_edge() {
  Scenario scenario = edges(Edge::kGrass, 0.05);
  scenario.roads[0].rows = {row(Thing::kHedge, RoadSide::kLeft, 0.0, 1e4, 0.6),
                            row(Thing::kTree, RoadSide::kRight, 5.0, 1e4, 1.5, 9.0)};
  return scenario;
}

Scenario lowered_kerbs() {
  RoadConfig road = straight(200.0);
  road.gaps = {{RoadSide::kRight, 75.0, 2.0, 0.0, 0.3},
               {RoadSide::kLeft, 85.0, 3.0, 0.02, 0.5},
               {RoadSide::kRight, 95.0, 1.2, 0.0, 0.3},
               {RoadSide::kLeft, 105.0, 4.0, 0.03, 1.0}};
  Scenario scenario = on_road(road, 60.0, -2.0);
  scenario.roads.push_back(driveway(1, 120.0, RoadSide::kRight, 2.5));
  return scenario;
}

Scenario islands_and_bays() {
  RoadConfig road = straight(200.0, 10.0);
  road.islands = {{75.0, 0.0, 10.0, 1.6}, {110.0, 0.0, 4.0, 2.0}};
  road.bays = {{RoadSide::kRight, 85.0, 18.0, 2.2, 1.5}, {RoadSide::kLeft, 70.0, 30.0, 2.2, 1.5}};
  road.rows = {row(Thing::kCar, RoadSide::kRight, 87.0, 104.0, -0.2),
               row(Thing::kVan, RoadSide::kLeft, 73.0, 90.0, -0.1)};
  return on_road(road, 60.0, -2.5);
}

Scenario widths() {
  RoadConfig road = straight(200.0, 6.0);
  road.widths = {{70.0, 6.0}, {90.0, 13.0}, {110.0, 13.0}, {130.0, 4.0}};
  return on_road(road, 60.0);
}

// --- Ground
// ---------------------------------------------------------------------------------------------------------

Scenario grade(std::vector<HeightAt> heights, double curve_m) {
  RoadConfig road = straight(240.0);
  road.heights = std::move(heights);
  road.vertical_curve_m = curve_m;
  return on_road(road, 60.0, -2.0);
}

Scenario rough() {
  Scenario scenario = on_road(straight(160.0), 50.0, -2.0);
  scenario.ground.roughness_m = 0.02;
  return scenario;
}

Scenario banked() {
  RoadConfig road;
  road.pieces = {{60.0}};
  append(road.pieces, bend(-60.0, 80.0, 30.0));
  road.pieces.push_back({60.0});
  Scenario scenario = on_road(road, 50.0, -2.0);
  scenario.ground.crown = 0.0;
  scenario.ground.cross_fall = 0.05;
  return scenario;
}

Scenario in_weather(const Weather& weather) {
  Scenario scenario = street();
  scenario.weather = weather;
  return scenario;
}

Scenario reflectors() {
  Scenario scenario = street();
  scenario.roads[0].rows.push_back(row(Thing::kSign, RoadSide::kRight, 5.0, 1e4, 0.4, 12.0));
  scenario.weather.bloom_mrad = 10.0;
  return scenario;
}

// --- The papers'
// --------------------------------------------------------------------------------------------------

// Side roads of 4 to 5 m with corners of one radius, and, between them, what looks like one: driveways, gaps
// of the kerb, gaps between parked cars. A four-layer scanner 1 m up, turned down by 13.4 degrees (A0.2).
Scenario paper1(double radius_m, double speed_kmh) {
  RoadConfig road = straight(420.0, 5.0);
  road.kerb_m = 0.15;
  road.sidewalk_m = 1.5;
  road.gaps = {{RoadSide::kRight, 105.0, 1.5, 0.0, 0.3}, {RoadSide::kLeft, 225.0, 2.5, 0.0, 0.3}};
  road.bays = {{RoadSide::kRight, 158.5, 32.0, 2.0, 1.5}};
  road.rows = {row(Thing::kCar, RoadSide::kRight, 160.2, 192.0, -0.2, 2.2)};
  road.rows[0].width_m = 1.7;  // their sides stand 0.1 m behind the kerb's line
  Scenario scenario = on_road(road, 20.0, 0.0, speed_kmh / 3.6);
  const std::vector<std::pair<double, RoadSide>> corners = {{60.0, RoadSide::kRight},
                                                            {130.0, RoadSide::kLeft},
                                                            {260.0, RoadSide::kRight},
                                                            {340.0, RoadSide::kLeft}};
  double width_m = 4.0;
  for (const auto& [at_m, side] : corners) {
    scenario.roads.push_back(branch(1, at_m, side, width_m, radius_m, 40.0));
    width_m = width_m == 4.0 ? 5.0 : 4.0;
  }
  scenario.roads.push_back(driveway(1, 95.0, RoadSide::kLeft, 1.0));
  scenario.roads.push_back(driveway(1, 295.0, RoadSide::kRight, 2.5));
  scenario.stand = {.height_m = 1.0, .pitch_deg = 13.4, .roll_deg = 0.0, .forward_deg = 0.0, .ahead_m = 1.8};
  return scenario;
}

// Two lanes between rows of parked cars; a four-layer scanner 0.5 m up, 1.5 degrees down.
Scenario paper2() {
  RoadConfig road = straight(220.0, 11.0);
  road.kerb_m = 0.12;
  road.rows = {row(Thing::kCar, RoadSide::kLeft, 10.0, 1e4, -0.25, 1.3),
               row(Thing::kCar, RoadSide::kRight, 12.0, 1e4, -0.25, 1.1),
               row(Thing::kTree, RoadSide::kRight, 5.0, 1e4, 0.5, 8.0)};
  road.items = {{.what = Thing::kPerson, .at_m = 65.0, .lateral_m = 6.5, .speed_mps = -1.2},
                {.what = Thing::kCar, .at_m = 150.0, .lateral_m = 1.7, .yaw_deg = 180.0, .speed_mps = -6.0}};
  Scenario scenario = on_road(road, 30.0, -1.7, 5.0);
  scenario.stand = {.height_m = 0.5, .pitch_deg = 1.5, .roll_deg = 0.0, .forward_deg = 0.0, .ahead_m = 2.0};
  return scenario;
}

Scenario paper3(double width_m, bool curved) {
  RoadConfig road = straight(curved ? 60.0 : 300.0, width_m);
  if (curved) {
    for (const double deg : {70.0, -70.0, 70.0}) append(road.pieces, bend(deg, 40.0, 15.0));
    road.pieces.push_back({60.0});
  }
  road.kerb_m = 0.15;
  Scenario scenario = on_road(road, curved ? 55.0 : 60.0, -0.25 * width_m);
  scenario.stand = {.height_m = 1.9, .pitch_deg = 0.0, .roll_deg = 0.0, .forward_deg = 0.0, .ahead_m = 0.0};
  return scenario;
}

// --- Triggers
// -----------------------------------------------------------------------------------------------------

Scenario construction() {
  RoadConfig road = straight(200.0, 9.0);
  road.rows = {row(Thing::kBarrel, RoadSide::kRight, 70.0, 120.0, -2.6, 2.4)};
  road.items = {{.what = Thing::kTruck, .at_m = 98.0, .lateral_m = -3.0},
                {.what = Thing::kPerson, .at_m = 85.0, .lateral_m = -3.4}};
  return on_road(road, 60.0, 0.5, 5.0);
}

Scenario people_near() {
  RoadConfig road = straight(120.0, 7.0);
  road.items = {{.what = Thing::kPerson, .at_m = 51.5, .lateral_m = 0.0},
                {.what = Thing::kPerson, .at_m = 50.0, .lateral_m = -3.2},
                {.what = Thing::kPerson, .at_m = 49.0, .lateral_m = -0.2},
                {.what = Thing::kPerson, .at_m = 55.0, .lateral_m = 3.0, .across_mps = -1.4}};
  return on_road(road, 50.0, -1.7, 0.0);
}

Scenario trailers() {
  RoadConfig road = straight(200.0, 9.0);
  road.items = {
      {.what = Thing::kCar, .at_m = 72.0, .lateral_m = -2.2, .speed_mps = 5.0},
      {.what = Thing::kTrailer, .at_m = 65.5, .lateral_m = -2.2, .speed_mps = 5.0, .length_m = 6.0},
      {.what = Thing::kTruck, .at_m = 110.0, .lateral_m = 2.2, .yaw_deg = 180.0, .speed_mps = -6.0},
      {.what = Thing::kTrailer, .at_m = 119.0, .lateral_m = 2.2, .yaw_deg = 180.0, .speed_mps = -6.0}};
  return on_road(road, 52.0, -2.2, 5.0);
}

Scenario tilted(double deg) {
  Scenario scenario = on_road(straight(200.0), 60.0, -2.0);
  scenario.stand.pitch_deg = deg;
  scenario.stand.roll_deg = deg;
  return scenario;
}

// Swerves on a wide road at 60 degrees a second: 5.5 m/s on a radius of 5.25 m.
Scenario swerve() {
  Scenario scenario = on_road(straight(140.0, 13.0), 40.0, -2.0, 5.5);
  constexpr double kCurvature = std::numbers::pi / 3.0 / 5.5;
  constexpr double kTurn_m = 4.0;
  scenario.course.pieces = {
      {6.0}, {kTurn_m, kCurvature}, {2.0 * kTurn_m, -kCurvature}, {kTurn_m, kCurvature}, {30.0}};
  return scenario;
}

std::vector<ReadyScenario> make_list() {
  std::vector<ReadyScenario> list = {
      {"straight", "a straight road of 8 m with kerbs of 0.12 m", straight_road},
      {"curve", "quarter turns of 30 m radius, left and right in turn", curved_road},
      {"street", "60 m straight, then turns of 30 m radius, between houses", street},
      {"campus", "a loop with side roads, parked cars, people, trees, hedges, a guard rail", campus},
      {"left", "a side road to the left", [] { return junction({RoadSide::kLeft}); }},
      {"right", "a side road to the right", [] { return junction({RoadSide::kRight}); }},
      {"t", "the road ends at one across", t_junction},
      {"crossing", "roads to both sides",
       [] {
         return junction({RoadSide::kLeft, RoadSide::kRight});
       }},
      {"roundabout", "a ring of 14 m radius with four roads", roundabout},
      {"dead-end", "a road that ends at its kerb", dead_end},
      {"sloped-kerb", "kerbs with a sloped face", [] { return kerb(0.12, KerbFace::kSloped); }},
      {"worn-kerb", "kerbs with a rounded face", [] { return kerb(0.12, KerbFace::kWorn); }},
      {"kerb-3cm", "kerbs of 3 cm", [] { return kerb(0.03); }},
      {"kerb-5cm", "kerbs of 5 cm", [] { return kerb(0.05); }},
      {"kerb-10cm", "kerbs of 10 cm", [] { return kerb(0.10); }},
      {"kerb-15cm", "kerbs of 15 cm", [] { return kerb(0.15); }},
      {"no-kerb", "painted edges alone", [] { return edges(Edge::kFlush); }},
      {"grass", "grass beside the road", [] { return edges(Edge::kGrass, 0.03); }},
      {"ditch", "ditches beside the road", [] { return edges(Edge::kDitch, 0.03); }},
      {"walls", "walls beside the road", [] { return edges(Edge::kWall); }},
      {"vegetation-edge", "grass, a hedge and trees beside the road", vegetation_edge},
      {"lowered-kerbs", "lowered kerbs, gaps and a driveway", lowered_kerbs},
      {"islands", "islands and parking bays", islands_and_bays},
      {"widths", "a road that widens from 6 to 13 m and narrows to 4", widths},
      {"steep-grade", "a climb of 12 %",
       [] {
         return grade({{70.0, 0.0}, {240.0, 20.4}}, 30.0);
       }},
      {"crest", "8 % up, then 8 % down",
       [] {
         return grade({{60.0, 0.0}, {110.0, 4.0}, {160.0, 0.0}}, 20.0);
       }},
      {"rough", "bumps of 2 cm", rough},
      {"banked", "a bend with a cross-fall of 5 %", banked},
      {"construction", "barrels, a truck and a worker on the carriageway", construction},
      {"people-near", "people within 2 m of the vehicle, one crossing", people_near},
      {"trailers", "a car and a truck with trailers", trailers},
      {"tilt-1deg", "the sensor pitched and rolled by 1 degree", [] { return tilted(1.0); }},
      {"tilt-3deg", "the sensor pitched and rolled by 3 degrees", [] { return tilted(3.0); }},
      {"tilt-5deg", "the sensor pitched and rolled by 5 degrees", [] { return tilted(5.0); }},
      {"swerve", "the vehicle turns by 60 degrees a second", swerve},
      {"heavy-rain", "50 mm of rain an hour on a wet street",
       [] { return in_weather({.rain_mmph = 50.0, .wet_road = 0.6}); }},
      {"wet-road", "a street after the rain", [] { return in_weather({.wet_road = 0.8}); }},
      {"dirty-window", "a third of the window is dirty, ahead and to the left",
       [] { return in_weather({.dirt = 0.33, .dirt_from_deg = -20.0, .dirt_to_deg = 90.0}); }},
      {"reflectors", "signs that outshine what is around them", reflectors}};
  for (const double radius_m : {0.5, 3.0, 8.0}) {
    for (const double speed_kmh : {10.0, 30.0, 60.0}) {
      list.push_back({fmt::format("paper1-r{}-v{}", radius_m, speed_kmh),
                      fmt::format("paper 1: corners of {} m at {} km/h, and false ones", radius_m, speed_kmh),
                      [=] { return paper1(radius_m, speed_kmh); }});
    }
  }
  list.push_back({"paper2", "paper 2: two lanes between parked cars", paper2});
  for (const double width_m : {13.0, 6.0}) {
    for (const bool curved : {false, true}) {
      list.push_back({fmt::format("paper3-{}m-{}", width_m, curved ? "curved" : "straight"),
                      fmt::format("paper 3: a {} road of {} m", curved ? "curved" : "straight", width_m),
                      [=] { return paper3(width_m, curved); }});
    }
  }
  return list;
}

}  // namespace

std::span<const ReadyScenario> ready_scenarios() {
  static const std::vector<ReadyScenario> list = make_list();
  return list;
}

Scenario ready_scenario(std::string_view name) {
  std::vector<std::string_view> names;
  for (const ReadyScenario& ready : ready_scenarios()) {
    if (ready.name == name) return ready.make();
    names.push_back(ready.name);
  }
  const std::string_view near = nearest_word(name, names);
  throw std::invalid_argument(near.empty()
                                  ? fmt::format("unknown scenario '{}'", name)
                                  : fmt::format("unknown scenario '{}' (did you mean '{}'?)", name, near));
}

}  // namespace verge::sim
