// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/study/tally.hpp"

#include <algorithm>
#include <utility>

namespace verge::study {
namespace {

void add_histograms(std::vector<Histogram>& sum, const std::vector<Histogram>& more) {
  if (sum.size() < more.size()) sum.resize(more.size());
  for (std::size_t i = 0; i < more.size(); ++i) sum[i] += more[i];
}

void add_lateral(Tally& tally, const eval::LateralError& error) {
  tally.lateral_m.add(error.outward_m);
  const auto ring = static_cast<std::size_t>(error.range_m / tally.by_range.width_m);
  if (ring >= tally.lateral_by_range_m.size()) tally.lateral_by_range_m.resize(ring + 1);
  tally.lateral_by_range_m[ring].add(error.outward_m);
  if (error.heading_rad) tally.heading_rad.add(*error.heading_rad);
}

}  // namespace

Tally& Tally::operator+=(const Tally& more) {
  scans += more.scans;
  absent += more.absent;
  damaged += more.damaged;
  if (!more.cells.empty()) eval::add_cells(cells, more.cells);
  by_range += more.by_range;
  if (!more.by_confidence.empty()) eval::add_points(by_confidence, more.by_confidence);
  stations += more.stations;
  straight += more.straight;
  curve += more.curve;
  lateral_m += more.lateral_m;
  add_histograms(lateral_by_range_m, more.lateral_by_range_m);
  heading_rad += more.heading_rad;
  objects += more.objects;
  corners += more.corners;
  labels += more.labels;
  labelled += more.labelled;
  seconds += more.seconds;
  poorest.insert(poorest.end(), more.poorest.begin(), more.poorest.end());
  return *this;
}

void add_scene(Tally& tally, const eval::SceneEvaluation& scan) {
  tally.scans += scan.scans;
  tally.absent += scan.absent;
  eval::add_cells(tally.cells, scan.cells);
  tally.by_range += scan.by_range;
  eval::add_points(tally.by_confidence, scan.by_confidence);
  tally.stations += eval::pooled(scan.stations);
  tally.straight += scan.straight;
  tally.curve += scan.curve;
  for (const eval::LateralError& error : scan.lateral) add_lateral(tally, error);
  tally.objects += scan.objects;
}

void note_poorest(Tally& tally, ScanScore scan) {
  if (tally.poorest.empty()) {
    tally.poorest.push_back(std::move(scan));
  } else if (scan.f1 < tally.poorest.front().f1) {
    tally.poorest.front() = std::move(scan);
  }
}

}  // namespace verge::study
