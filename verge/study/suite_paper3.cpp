// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include <vector>

#include "verge/sim/ready.hpp"
#include "verge/sim/sensors.hpp"
#include "verge/study/suite_list.hpp"

// The frames of paper 3 (Zhong et al. 2017): 670 of campus roads, and 310 of structured roads, which its four
// percentages allow to be 230 straight and 80 corner ones. Drives of odd numbers are on the 13 m road, even
// ones on the 6 m road. Frames are 4 m apart, so that they are not the same frame again.

namespace verge::study {
namespace {

constexpr std::uint64_t kStep = 5;  // scans of 0.8 m

enum class Road { kStraight, kBends, kBoth };

/// Straights between the bends, so that about half of the road is straight.
void put_straights_between(std::vector<sim::Piece>& pieces) {
  constexpr std::ptrdiff_t kPiecesABend = 3;
  const sim::Piece straight{70.0};
  pieces.insert(pieces.begin() + 1 + 2 * kPiecesABend, straight);
  pieces.insert(pieces.begin() + 1 + kPiecesABend, straight);
}

sim::DriveConfig drive_on(Road kind, std::uint64_t drive) {
  const bool wide = drive % 2 == 1;
  sim::DriveConfig config;
  config.scenario = sim::ready_scenario(std::string(wide ? "paper3-13m-" : "paper3-6m-") +
                                        (kind == Road::kStraight ? "straight" : "curved"));
  sim::RoadConfig& road = config.scenario.roads[0];
  if (kind == Road::kBoth) put_straights_between(road.pieces);
  road.kerb_m = drawn(drive, 0, 0.12, 0.18);
  for (const sim::RoadSide side : {sim::RoadSide::kLeft, sim::RoadSide::kRight})
    road.rows.push_back({.what = sim::Thing::kHouse, .side = side, .beside_m = 4.0, .gap_m = 6.0});
  sim::Course& course = config.scenario.course;
  course.at_m = kind == Road::kBends ? drawn(drive, 1, 68.0, 90.0) : drawn(drive, 1, 20.0, 40.0);
  course.lateral_m += drawn(drive, 2, -0.5, 0.5);
  config.sensor = sim::sensor_named("hdl32e");
  config.noise.seed = drive;
  config.noise.range_sigma_m = 0.02;
  return config;
}

Cell cell(std::string name, Road kind, std::size_t drives, std::size_t scans, const SuiteRequest& request) {
  return {std::move(name), MadeDrives{.make = [kind](std::uint64_t drive) { return drive_on(kind, drive); },
                                      .drives = request.drives.value_or(drives),
                                      .scans = request.scans.value_or(scans),
                                      .step = kStep}};
}

std::vector<Printed> printed_figures() {
  constexpr const char* kPaper = "paper 3, printed: its method";
  constexpr const char* kLda = "paper 3, printed: LDA";
  constexpr const char* kLater = "Sensors 19(7) 1551 (2019), printed: multi-feature search window";
  return {{"670 frames", kPaper, {{"success", 0.96}}}, {"straight", kPaper, {{"success", 0.957}}},
          {"straight", kLda, {{"success", 0.913}}},    {"straight", kLater, {{"success", 0.9754}}},
          {"corner", kPaper, {{"success", 0.825}}},    {"corner", kLda, {{"success", 0.738}}},
          {"corner", kLater, {{"success", 0.9256}}}};
}

}  // namespace

Suite paper3_suite(const SuiteRequest& request) {
  Suite suite;
  suite.name = "paper3";
  suite.title = "Paper 3: success of frames";
  suite.about =
      "A frame is a success where at least 90 % of the visible truth within 20 m is found within 0.2 m and "
      "nothing "
      "found is more than 0.5 m off (minimum deviation), or 0.5 m and 1 m (larger deviation); low and high "
      "bound the "
      "share with 95 % (Wilson). HDL-32E, range noise 2 cm, roads of 13 and 6 m, kerbs of 12 to 18 cm. "
      "Printed figures "
      "are those of their papers, of other roads, with limits that they do not state.";
  suite.cells = {cell("670 frames", Road::kBoth, 10, 67, request),
                 cell("straight", Road::kStraight, 10, 23, request),
                 cell("corner", Road::kBends, 8, 10, request)};
  suite.columns = {{"frames", "frames", 0},  {"success", "success"}, {"success_low", "low"},
                   {"success_high", "high"}, {"minimum", "min.", 0}, {"larger", "larger", 0},
                   {"failed", "failed", 0},  {"f1", "F1 at 0.2 m"},  {"lateral_p95_m", "95 % error m"}};
  suite.printed = printed_figures();
  // Both widths of the paper's Fig. 6 and 7. The bend begins abreast of the vehicle, so that the curvature
  // tells its straight part from its round one.
  suite.road_figures = {{"a straight road of 13 m", "straight", 1, 0, false},
                        {"a bend of a road of 6 m", "corner", 2, 0, true}};
  return suite;
}

}  // namespace verge::study
