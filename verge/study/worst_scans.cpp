// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include <fmt/format.h>

#include "verge/study/album.hpp"
#include "verge/study/parts.hpp"
#include "verge/study/report.hpp"

namespace verge::study {
namespace {

constexpr Reach kAround{22.0, 22.0, 22.0};

/// A contestant's poorest scan of a cell.
struct Poorest {
  std::size_t cell = 0;
  ScanScore scan;
};

std::vector<Poorest> poorest_of(const Results& results, std::size_t contestant, std::size_t most) {
  std::vector<Poorest> all;
  for (std::size_t cell = 0; cell < results.suite.cells.size(); ++cell) {
    const auto& scans = results.tally(cell, contestant).poorest;
    const auto least = std::ranges::min_element(scans, {}, &ScanScore::f1);
    if (least != scans.end()) all.push_back({cell, *least});
  }
  std::ranges::stable_sort(all, {}, [](const Poorest& one) { return one.scan.f1; });
  if (all.size() > most) all.resize(most);
  return all;
}

std::string caption_of(const Results& results, std::size_t contestant, const Poorest& poorest) {
  const ScanScore& scan = poorest.scan;
  const std::string where = scan.drive == 0 ? fmt::format("scan {}", scan.frame)
                                            : fmt::format("drive {}, scan {}", scan.drive, scan.scan);
  return fmt::format("{}: {}, {}, F1 {:.3f}", results.contestants[contestant].name,
                     results.suite.cells[poorest.cell].name, where, scan.f1);
}

}  // namespace

Expected<std::vector<Picture>> worst_scans(const Results& results, std::size_t most) {
  std::vector<Picture> pictures;
  for (std::size_t i = 0; i < results.contestants.size(); ++i) {
    for (const Poorest& poorest : poorest_of(results, i, most)) {
      const auto seen = see_again(results.suite.cells[poorest.cell], poorest.scan, results.contestants[i]);
      if (!seen) return Unexpected(seen.error());
      auto picture = from_above(
          caption_of(results, i, poorest),
          {.scan = seen->frame.scan, .scene = seen->frame.scene, .trace = nullptr, .truth = &seen->truth},
          kAround);
      if (!picture) return Unexpected(std::move(picture).error());
      pictures.push_back(*std::move(picture));
    }
  }
  return pictures;
}

}  // namespace verge::study
