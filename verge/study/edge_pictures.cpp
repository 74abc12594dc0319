// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include <fmt/format.h>

#include "verge/detect/registry.hpp"
#include "verge/emit/raster_plot.hpp"
#include "verge/study/album.hpp"
#include "verge/study/parts.hpp"
#include "verge/study/report.hpp"

// Paper 2's Fig. 5 and 12 to 18 from our scans, and what the method finds there by default.

namespace verge::study {
namespace {

constexpr std::string_view kMethod = "line_fit";
constexpr double kGate_m = 50.0;  // Fig. 6

constexpr Reach kAll{120.0, 10.0, 65.0};
constexpr Reach kGated{52.0, 2.0, 27.0};
constexpr Reach kNear{32.0, 2.0, 17.0};

/// What the method makes of a prepared scan.
pipeline::Frame traced(const Scan& scan, const std::vector<Setting>& settings) {
  pipeline::Frame frame;
  frame.scan = scan;
  detect_traced(frame, *detect::make(kMethod, settings), std::string(kMethod));
  return frame;
}

/// The returns of the four layers, those beyond the gate apart.
Trace by_gate(const Trace& ungated) {
  Trace trace;
  trace.points = {{fmt::format("within {:g} m", kGate_m), {}, {}},
                  {fmt::format("beyond {:g} m", kGate_m), {}, {}}};
  const Trace::Points* all = ungated.find_points("gate");
  if (all == nullptr) return trace;
  for (const Vec3 p : all->points) {
    const int group = norm(p) < kGate_m ? 0 : 1;
    Trace::Points& layer = trace.points.at(static_cast<std::size_t>(group));
    layer.points.push_back(p);
    layer.group.push_back(group);
  }
  return trace;
}

/// Where the accumulator's peaks are: theta in degrees and rho in metres.
std::vector<Vec2> peaks_of(const Trace& trace) {
  constexpr std::size_t kOfEach = 3;  // theta, rho, count
  std::vector<Vec2> peaks;
  const Trace::Values* values = trace.find_values("peaks");
  if (values == nullptr) return peaks;
  for (std::size_t i = 0; i + kOfEach <= values->values.size(); i += kOfEach)
    peaks.push_back({values->values[i], values->values[i + 1]});
  return peaks;
}

/// None where the scan has too little for one.
void add_raster(Album& album, std::string caption, const Trace& trace, std::string_view name,
                emit::RasterColours colours, const std::vector<Vec2>& marks = {}) {
  const Trace::Raster* raster = trace.find_raster(name);
  if (raster != nullptr) album.add(std::move(caption), emit::raster_png(*raster, colours, marks));
}

/// What the paper does, in its order.
void add_printed(const Scan& scan, Album& album) {
  using emit::RasterColours;
  const Trace all = *traced(scan, {{"reading", "paper"}, {"range_max_m", "500"}}).trace;
  const Trace printed = *traced(scan, {{"reading", "paper"}}).trace;
  album.layers("Fig. 5, 14: the returns of four layers, those beyond the range gate in another colour",
               by_gate(all), kAll);
  album.layers("Fig. 15a (by the code of Fig. 6): those within the gate, by layer", only(printed, {"gate"}),
               kGated);
  album.layers("Fig. 12: the third layer", only(printed, {"layer"}), kGated);
  add_raster(album, "Fig. 15b: its points marked as squares", printed, "squares", RasterColours::kGrey);
  add_raster(album, "Fig. 15c: edges of the squares, by Canny", printed, "edges", RasterColours::kGrey);
  add_raster(album, "Fig. 16a: the Hough accumulator with its peaks", printed, "accumulator",
             RasterColours::kHeat, peaks_of(printed));
  album.layers("Fig. 16b: Hough lines", only(printed, {"layer"}, {"hough segment "}), kGated);
  album.layers("Fig. 13: two clusters by k-means, and their centroids",
               only(printed, {"groups", "centroids"}), kGated);
  album.layers("Fig. 17: lines through all points of the layer, least squares red, Theil and Sen green",
               only(printed, {"layer"}, {"least_squares ", "theil_sen "}), kGated);
  album.layers("Fig. 18: a polynomial of degree 16 at the most, with a specified error, through the same",
               only(printed, {"layer"}, {"polynomial "}), kGated);
}

/// The same estimators where the points were put in groups before, and what comes of it.
void add_ours(const Scan& scan, const Scene* truth, Album& album) {
  const Trace clusters =
      *traced(scan, {{"grouping", "kmeans"}, {"layer", "2"}, {"estimator", "least_squares"}}).trace;
  album.layers("As Fig. 17, k-means first: a line of each kind through each of the two clusters",
               only(clusters, {"groups", "centroids"}, {"least_squares ", "theil_sen "}), kGated);
  const pipeline::Frame usual = traced(scan, {});
  album.layers("As Fig. 17, through the returns of each side's kerb (grouping = kerb)",
               only(*usual.trace, {"groups"}, {"least_squares ", "theil_sen "}), kNear);
  album.found("By default: edges, objects by class with their signs; the truth dashed", usual.scene, truth,
              kNear);
}

/// A scan from the middle of a cell.
Expected<ScanScore> middle_of(const Cell& cell) {
  if (const auto* drives = std::get_if<MadeDrives>(&cell.scans))
    return ScanScore{
        .drive = 1, .scan = drives->first_scan + drives->step * (drives->scans / 2), .frame = {}};
  const auto known = known_scans(std::get<LabelledScans>(cell.scans));
  if (!known) return Unexpected(known.error());
  const std::size_t middle = known->size() / 2;
  return ScanScore{.scan = middle, .frame = known->at(middle).frame};
}

/// How many of the true objects were seen.
std::string seen_in(const Scene& truth) {
  const auto seen =
      std::ranges::count_if(truth.objects, [](const Object& object) { return object.confidence > 0.0; });
  return fmt::format("{} of {} true objects are seen.", seen, truth.objects.size());
}

Expected<Gallery> gallery_of(const Cell& cell) {
  const auto middle = middle_of(cell);
  if (!middle) return Unexpected(middle.error());
  const auto seen = see_again(cell, *middle, contestant_of(kMethod));
  if (!seen) return Unexpected(seen.error());
  auto pictures = edge_pictures(seen->frame.scan, &seen->truth);
  if (!pictures) return Unexpected(std::move(pictures).error());
  std::string about = fmt::format(
      "Scan {}, heading up. What the paper prints is by reading = paper; its own data were never published.",
      seen->frame.scan.frame);
  if (!seen->truth.objects.empty()) about += ' ' + seen_in(seen->truth);
  return Gallery{fmt::format("Figures of paper 2: {}", cell.name), std::move(about), *std::move(pictures)};
}

}  // namespace

Expected<std::vector<Picture>> edge_pictures(const Scan& scan, const Scene* truth) {
  Album album(scan);
  add_printed(scan, album);
  add_ours(scan, truth, album);
  return album.finish();
}

Expected<std::vector<Gallery>> edge_galleries(const Results& results) {
  std::vector<Gallery> galleries;
  const bool judged =
      results.suite.judged.objects &&
      std::ranges::find(results.contestants, kMethod, &Contestant::method) != results.contestants.end();
  if (!judged) return galleries;
  for (const Cell& cell : results.suite.cells) {
    auto gallery = gallery_of(cell);
    if (!gallery) return Unexpected(std::move(gallery).error());
    galleries.push_back(*std::move(gallery));
  }
  return galleries;
}

}  // namespace verge::study
