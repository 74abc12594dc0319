// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include <fmt/format.h>

#include "verge/emit/curvature_plot.hpp"
#include "verge/study/album.hpp"
#include "verge/study/parts.hpp"
#include "verge/study/report.hpp"

// Paper 3's Fig. 2, 3, 4, 6 and 7 from the scans that a suite names.

namespace verge::study {
namespace {

constexpr std::string_view kMethod = "gradient";
constexpr Reach kAround{24.0, 24.0, 24.0};

/// The scan that is asked for; none where a labelled set does not have so many.
std::optional<ScanScore> wanted_of(const Cell& cell, const RoadFigure& figure) {
  const auto* set = std::get_if<LabelledScans>(&cell.scans);
  if (set == nullptr) return ScanScore{.drive = figure.drive, .scan = figure.scan, .frame = {}};
  const auto known = known_scans(*set);
  if (!known || figure.scan >= known->size()) return std::nullopt;
  return ScanScore{.scan = figure.scan, .frame = known->at(figure.scan).frame};
}

/// The layers before denoising. Points of the four regions are of one colour, so that candidates stand out.
Trace before_denoising(const Trace& all) {
  Trace trace = only(all, {"low", "gradient points", "candidates"});
  for (Trace::Points& layer : trace.points) layer.group.clear();
  return trace;
}

/// Fig. 2 or 3. The printed reading has no such step of its own.
void add_denoising(const std::string& name, const Trace& trace, bool bend, Album& album) {
  if (trace.find_points("clusters") == nullptr) return;
  const char* figure = bend ? "Fig. 3" : "Fig. 2";
  album.layers(
      fmt::format("{}: {}, before denoising: points with obvious gradient, and the candidate of each "
                  "scan line and region",
                  figure, name),
      before_denoising(trace), kAround);
  album.layers(fmt::format("{}: {}, after denoising: a cluster a boundary, and the fit", figure, name),
               only(trace, {"low", "clusters"}, {"fit"}), kAround);
}

/// Fig. 4; none where every boundary is a line.
void add_curvature(const std::string& name, const Trace& trace, Album& album) {
  const std::vector<emit::CurvatureCurve> curves = emit::curvature_curves(trace);
  const auto longest =
      std::ranges::max_element(curves, {}, [](const auto& curve) { return curve.s_m.back(); });
  if (longest == curves.end()) return;
  album.add(fmt::format("Fig. 4: {}, curvature along the longest B-spline", name),
            emit::curvature_png(*longest));
}

/// A contestant and what it made of the scan.
struct View {
  const Contestant& contestant;
  Seen seen;
};

/// The scan as a contestant sees it, with a trace where it need see no other scan; `first` is the same scan.
Expected<Seen> seen_by(const Contestant& contestant, const Cell& cell, const ScanScore& wanted,
                       const Seen& first) {
  if (contestant.predictions) return see_again(cell, wanted, contestant);
  const auto detector = detector_of(contestant);
  if (detector->order() == detect::Order::kSequential) return see_again(cell, wanted, contestant);
  Seen seen = first;
  detect_traced(seen.frame, *detector, contestant.name);
  return seen;
}

/// That scan as each contestant saw it that says boundaries.
Expected<std::vector<View>> views_of(const Results& results, const Cell& cell, const ScanScore& wanted) {
  std::vector<View> views;
  std::optional<Seen> first;
  for (const Contestant& contestant : results.contestants) {
    if (!contestant.says.boundaries) continue;
    if (!first) {
      auto seen = see_again(cell, wanted, contestant);
      if (!seen) return Unexpected(std::move(seen).error());
      first = *std::move(seen);
    }
    auto seen = seen_by(contestant, cell, wanted, *first);
    if (!seen) return Unexpected(std::move(seen).error());
    views.push_back({contestant, *std::move(seen)});
  }
  return views;
}

/// The method's steps, then what each contestant found.
Expected<std::vector<Picture>> pictures_of(const std::vector<View>& views, bool bend) {
  Album album(views.front().seen.frame.scan);
  for (const auto& [contestant, seen] : views) {
    if (contestant.method != kMethod) continue;
    add_denoising(contestant.name, *seen.frame.trace, bend, album);
    if (bend) add_curvature(contestant.name, *seen.frame.trace, album);
  }
  for (const auto& [contestant, seen] : views) {
    album.found(fmt::format("{}: boundaries by {}", bend ? "Fig. 7" : "Fig. 6", contestant.name),
                seen.frame.scene, &seen.truth, kAround);
  }
  return album.finish();
}

std::string about(const Cell& cell, const Scan& scan) {
  const std::string set = std::holds_alternative<LabelledScans>(cell.scans) ? " of " + cell.name : "";
  return fmt::format(
      "Scan {}{}, seen from above, heading up; the truth is in white dashes over what was found. The "
      "paper's own scans were never published.",
      scan.frame, set);
}

/// Adds none where nobody says boundaries, or a labelled set does not have the scan.
Expected<void> add_gallery(const Results& results, const Cell& cell, const RoadFigure& figure,
                           std::vector<Gallery>& galleries) {
  const auto wanted = wanted_of(cell, figure);
  if (!wanted) return {};
  const auto views = views_of(results, cell, *wanted);
  if (!views) return Unexpected(views.error());
  if (views->empty()) return {};
  auto pictures = pictures_of(*views, figure.bend);
  if (!pictures) return Unexpected(std::move(pictures).error());
  galleries.push_back({fmt::format("Figures of paper 3: {}", figure.title),
                       about(cell, views->front().seen.frame.scan), *std::move(pictures)});
  return {};
}

}  // namespace

Expected<std::vector<Gallery>> boundary_galleries(const Results& results) {
  std::vector<Gallery> galleries;
  for (const RoadFigure& figure : results.suite.road_figures) {
    const auto cell = std::ranges::find(results.suite.cells, figure.cell, &Cell::name);
    if (cell == results.suite.cells.end()) continue;
    auto added = add_gallery(results, *cell, figure, galleries);
    if (!added) return Unexpected(std::move(added).error());
  }
  return galleries;
}

}  // namespace verge::study
