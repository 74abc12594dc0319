// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "verge/core/error.hpp"
#include "verge/model/scene.hpp"
#include "verge/scan/scan.hpp"
#include "verge/study/engine.hpp"

namespace verge::study {

/// Results as people read them on a terminal: title, tables, notes. `times`: also how long scans took.
[[nodiscard]] std::string text_report(const Results& results, bool times);

/// One object: for each cell and contestant all figures, and the counts by tolerance, range and confidence.
/// Run times stand apart, where asked for; all else is the same bytes for the same results.
[[nodiscard]] std::string json_report(const Results& results, bool times);

/// A row a cell and contestant, and one for what others printed; RFC 4180.
[[nodiscard]] std::string csv_report(const Results& results);

/// A scan as a picture, with what is to be said of it.
struct Picture {
  std::string png;
  std::string caption;
};

/// The scans that each contestant did worst on, one a cell at most, `most` a contestant: points, what was
/// found, and the truth over it. Fails as see_again() and emit::BevPlot::png().
[[nodiscard]] Expected<std::vector<Picture>> worst_scans(const Results& results, std::size_t most);

/// Of a suite that judges corners: a method's lines on the straight road, entering, passing and leaving a
/// corner, and the road's width over time with what each method made of it; of one drive of the middle cell.
/// Fails as emit::BevPlot::png().
[[nodiscard]] Expected<std::vector<Picture>> corner_pictures(const Results& results);

/// Pictures under a heading.
struct Gallery {
  std::string title;
  std::string about;
  std::vector<Picture> pictures;
};

/// Paper 2's figures from a scan that is prepared (pipeline::prepare): returns and gate, squares, edges,
/// accumulator, lines of each kind, clusters; then what line_fit finds by default, with the truth where it is
/// known. A figure that the scan has too little for is left out. Fails as emit::BevPlot::png().
[[nodiscard]] Expected<std::vector<Picture>> edge_pictures(const Scan& scan, const Scene* truth);

/// Of a suite that judges objects, where line_fit is judged: these pictures of a scan of each cell. Fails as
/// see_again() and edge_pictures().
[[nodiscard]] Expected<std::vector<Gallery>> edge_galleries(const Results& results);

/// Of a suite that names scans for them (Suite::road_figures): paper 3's Fig. 2, 3, 4, 6 and 7. Points before
/// and after denoising and the curvature of the longest B-spline by the contestants of method gradient, and
/// the boundaries of every contestant that says some, with the truth. A scan that the suite or its labelled
/// set does not have gives no gallery. Fails as see_again() and emit::BevPlot::png().
[[nodiscard]] Expected<std::vector<Gallery>> boundary_galleries(const Results& results);

/// One page that needs nothing beside it: no network, no script.
[[nodiscard]] std::string html_report(const Results& results, const std::vector<Gallery>& galleries,
                                      bool times);

}  // namespace verge::study
