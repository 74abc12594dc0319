// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <cstddef>

#include <fmt/format.h>

#include "verge/study/corner_drives.hpp"
#include "verge/study/suite_list.hpp"

// Table 1 of paper 1: corners of three radii at three speeds, a thousand true and more false ones each.

namespace verge::study {
namespace {

constexpr std::size_t kDrives = 250;  // of four true corners each

/// What the paper prints of a cell.
struct Row {
  double radius_m;
  double speed_kmh;
  double m1;
  double m2;
};

// "Large, medium, small curvature" is read as the radius of the kerb returns: 8, 3 and 0.5 m.
constexpr std::array kTable1 = {
    Row{0.5, 10.0, 0.8867, 0.1825}, Row{0.5, 30.0, 0.8902, 0.1492}, Row{0.5, 60.0, 0.8967, 0.0977},
    Row{3.0, 10.0, 0.8390, 0.1789}, Row{3.0, 30.0, 0.8378, 0.1531}, Row{3.0, 60.0, 0.8415, 0.1156},
    Row{8.0, 10.0, 0.7121, 0.1850}, Row{8.0, 30.0, 0.7351, 0.1538}, Row{8.0, 60.0, 0.7217, 0.1094}};

Suite suite_of(const SuiteRequest& request, bool coarse) {
  Suite suite;
  suite.name = coarse ? "paper1-coarse" : "paper1";
  suite.title =
      fmt::format("Paper 1: true and false corners, {:g} degrees from point to point", coarse ? 0.5 : 0.25);
  suite.about = corner_measures() + " The paper prints no counts and drove other roads.";
  suite.judged = {.boundaries = false, .corners = true, .objects = false};
  for (const Row& row : kTable1) {
    suite.cells.push_back({.name = fmt::format("{:g} m, {:g} km/h", row.radius_m, row.speed_kmh),
                           .scans = corner_drives({row.radius_m, row.speed_kmh, coarse}, kDrives, request)});
    suite.printed.push_back({suite.cells.back().name, "paper 1, printed", {{"m1", row.m1}, {"m2", row.m2}}});
  }
  suite.columns = corner_columns();
  return suite;
}

}  // namespace

Suite paper1_suite(const SuiteRequest& request) { return suite_of(request, false); }
Suite paper1_coarse_suite(const SuiteRequest& request) { return suite_of(request, true); }

}  // namespace verge::study
