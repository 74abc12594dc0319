// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include "verge/sim/noise.hpp"
#include "verge/sim/ready.hpp"

namespace verge::sim {
namespace {

/// Numbers drawn one after the other from a seed.
class Dice {
 public:
  explicit Dice(std::uint64_t seed) : seed_(seed) {}

  [[nodiscard]] double between(double low, double high) {
    // Rounded, so that the scenario reads well and comes back from its file.
    return std::round(1000.0 * (low + (high - low) * uniform({seed_, 0, count_++}, Draw::kScenario))) /
           1000.0;
  }
  [[nodiscard]] bool chance(double share) { return between(0.0, 1.0) < share; }
  [[nodiscard]] RoadSide side() { return chance(0.5) ? RoadSide::kLeft : RoadSide::kRight; }
  template <class T, std::size_t N>
  [[nodiscard]] T one_of(const std::array<T, N>& choices) {
    return choices.at(std::min(N - 1, static_cast<std::size_t>(between(0.0, static_cast<double>(N)))));
  }

 private:
  std::uint64_t seed_;
  std::uint64_t count_ = 0;
};

// Straights and gentle bends to one side and back, which never meet again.
std::vector<Piece> draw_line(Dice& dice) {
  std::vector<Piece> pieces = {{dice.between(40.0, 70.0)}};
  double way = 1.0;
  for (int i = 0; i < 3; ++i) {
    const double radius = dice.between(40.0, 150.0);
    const double clothoid = dice.between(8.0, 15.0);
    const double arc = dice.between(5.0, 0.4 * std::numbers::pi * 40.0);
    const double curvature = way / radius;
    pieces.insert(pieces.end(),
                  {{clothoid, 0.0, curvature}, {arc, curvature}, {clothoid, curvature, -curvature}});
    pieces.push_back({dice.between(20.0, 50.0)});
    way = -way;
  }
  return pieces;
}

double length_of(const std::vector<Piece>& pieces) {
  double sum = 0.0;
  for (const Piece& piece : pieces) sum += piece.length_m;
  return sum;
}

RoadConfig draw_road(Dice& dice) {
  constexpr std::array kEdges = {Edge::kKerb,  Edge::kKerb,  Edge::kKerb,
                                 Edge::kGrass, Edge::kFlush, Edge::kDitch};
  constexpr std::array kFaces = {KerbFace::kVertical, KerbFace::kSloped, KerbFace::kWorn};
  RoadConfig road;
  road.width_m = dice.between(3.0, 14.0);
  road.kerb_m = dice.between(0.03, 0.2);
  road.left = dice.one_of(kEdges);
  road.right = dice.one_of(kEdges);
  road.face = dice.one_of(kFaces);
  road.sidewalk_m = dice.between(1.0, 3.0);
  road.pieces = draw_line(dice);
  return road;
}

void draw_branches(Dice& dice, Scenario& scenario) {
  const double length = length_of(scenario.roads.front().pieces);
  for (double at = 30.0; at < length - 40.0; at += dice.between(45.0, 70.0)) {
    RoadConfig branch;
    branch.branch_of = 1;
    branch.at_m = std::round(at * 1000.0) / 1000.0;
    branch.side = dice.side();
    branch.driveway = dice.chance(0.3);
    branch.width_m = branch.driveway ? dice.between(1.0, 2.5) : dice.between(4.0, 7.0);
    branch.radius_m = branch.driveway ? 0.3 : dice.between(0.3, 12.0);
    branch.angle_deg = dice.between(75.0, 105.0);
    branch.kerb_m = scenario.roads.front().kerb_m;
    branch.sidewalk_m = scenario.roads.front().sidewalk_m;
    branch.pieces = {{branch.driveway ? 8.0 : 40.0}};
    scenario.roads.push_back(branch);
  }
}

void draw_things(Dice& dice, RoadConfig& road) {
  constexpr std::array kRows = {Thing::kCar,   Thing::kVan,   Thing::kTree,
                                Thing::kHedge, Thing::kHouse, Thing::kPole};
  constexpr std::array kItems = {Thing::kPerson, Thing::kCyclist, Thing::kCar, Thing::kBin};
  const double length = length_of(road.pieces);
  for (int i = 0; i < 4; ++i) {
    const Thing what = dice.one_of(kRows);
    const bool parked = what == Thing::kCar || what == Thing::kVan;
    if (parked && road.width_m < 7.0) continue;
    const double from = dice.between(0.0, 0.6 * length);
    road.rows.push_back({.what = what,
                         .side = dice.side(),
                         .from_m = from,
                         .to_m = from + dice.between(20.0, 80.0),
                         .beside_m = parked ? -0.2 : road.sidewalk_m + dice.between(0.3, 1.0),
                         .gap_m = dice.between(1.0, 8.0)});
  }
  for (int i = 0; i < 6; ++i) {
    const Thing what = dice.one_of(kItems);
    const double speed = what == Thing::kCar ? dice.between(4.0, 10.0) : dice.between(-1.5, 1.5);
    const bool beside = what == Thing::kPerson || what == Thing::kBin;
    const double lateral = beside ? 0.5 * road.width_m + dice.between(0.5, 1.0) : 0.25 * road.width_m;
    road.items.push_back({.what = what,
                          .at_m = dice.between(10.0, length - 10.0),
                          .lateral_m = dice.chance(0.5) && beside ? -lateral : lateral,
                          .yaw_deg = 180.0,
                          .speed_mps = what == Thing::kBin ? 0.0 : -std::fabs(speed)});
  }
}

}  // namespace

Scenario random_scenario(std::uint64_t seed) {
  Dice dice(seed);
  Scenario scenario;
  scenario.roads = {draw_road(dice)};
  draw_branches(dice, scenario);
  draw_things(dice, scenario.roads.front());
  scenario.ground.crown = dice.between(0.0, 0.03);
  scenario.ground.grass_m = dice.between(0.0, 0.05);
  scenario.ground.seed = static_cast<std::int64_t>(seed % 1'000'000'007ULL);
  scenario.course.at_m = 5.0;
  scenario.course.lateral_m = -0.25 * scenario.roads.front().width_m;
  scenario.course.speed_mps = dice.between(5.0, 14.0);
  return scenario;
}

}  // namespace verge::sim
