// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <span>
#include <stdexcept>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "verge/study/suite.hpp"
#include "verge/study/suite_list.hpp"

namespace verge::study {

namespace {

/// What makes no sense throws before the first scan is made.
Suite checked(Suite suite) {
  for (const Cell& cell : suite.cells) {
    if (const auto* drives = std::get_if<MadeDrives>(&cell.scans)) (void)drives->make(1);
  }
  return suite;
}

}  // namespace

std::span<const SuiteEntry> suites() {
  static constexpr std::array kSuites = {
      SuiteEntry{"paper1", "M1 and M2 by corner radius and speed, four-layer scanner", paper1_suite},
      SuiteEntry{"paper1-coarse", "the same with points half a degree apart", paper1_coarse_suite},
      SuiteEntry{"paper2", "a two-lane road between parked cars, LUX", paper2_suite},
      SuiteEntry{"paper2-real", "the same of public scans: labelled roads, and boxes round objects",
                 paper2_real_suite},
      SuiteEntry{"paper3", "670 frames, and 230 straight and 80 corner ones, HDL-32E", paper3_suite},
      SuiteEntry{"paper3-real", "its success on labelled real scans, straight roads and junctions",
                 paper3_real_suite},
      SuiteEntry{"real", "the labelled public sets", real_suite},
      SuiteEntry{"degradation", "what noise, kerb height, pitch, parked cars, lost returns and bends cost",
                 degradation_suite},
      SuiteEntry{"corners", "the same of corners: noise, kerb height, pitch, yaw, lost returns, parked cars",
                 corners_suite},
      SuiteEntry{"campus", "a drive round the campus, stretch by stretch", campus_suite}};
  return kSuites;
}

Suite suite_named(std::string_view name, const SuiteRequest& request) {
  std::vector<std::string_view> names;
  for (const SuiteEntry& entry : suites()) {
    if (entry.name == name) return checked(entry.make(request));
    names.push_back(entry.name);
  }
  throw std::invalid_argument(fmt::format("unknown suite '{}' (known: {})", name, fmt::join(names, ", ")));
}

}  // namespace verge::study
