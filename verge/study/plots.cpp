// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/study/plots.hpp"

#include <algorithm>
#include <functional>
#include <limits>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "verge/study/figures.hpp"
#include "verge/study/table.hpp"

namespace verge::study {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

/// A series a contestant from its tally of all cells.
std::vector<Series> of_each(const Results& results,
                            const std::function<std::vector<PlotPoint>(const Tally&)>& points) {
  std::vector<Series> series;
  for (std::size_t i = 0; i < results.contestants.size(); ++i)
    series.push_back({results.contestants[i].name, points(all_of(results, i))});
  return series;
}

Plot precision_recall(const Results& results) {
  Plot plot{
      .title = "Precision over recall",
      .about =
          "One line a method: each point is the boundaries of at least some confidence, all cells together.",
      .x_label = "recall",
      .y_label = "precision",
      .x_range = std::pair(0.0, 1.0),
      .y_max = 1.0,
      .series = {}};
  plot.series = of_each(results, [](const Tally& tally) {
    std::vector<PlotPoint> points;
    for (const eval::ConfidencePoint& at : tally.by_confidence)
      points.push_back({at.counts.recall().value_or(kNone), at.counts.precision().value_or(kNone)});
    return points;
  });
  return plot;
}

double middle_of(std::size_t ring, double width_m) { return (static_cast<double>(ring) + 0.5) * width_m; }

Plot error_by_range(const Results& results) {
  Plot plot{
      .title = "Lateral error by range",
      .about = "One line a method: the 95th percentile of the size of the lateral error in rings of 5 m.",
      .x_label = "range, m",
      .y_label = "95th percentile of the error, m",
      .series = {}};
  plot.series = of_each(results, [](const Tally& tally) {
    std::vector<PlotPoint> points;
    for (std::size_t ring = 0; ring < tally.lateral_by_range_m.size(); ++ring)
      points.push_back({middle_of(ring, tally.by_range.width_m),
                        tally.lateral_by_range_m[ring].sizes().percentile(95.0).value_or(kNone)});
    return points;
  });
  double farthest_m = 0.0;
  for (const Tally& tally : results.tallies) {
    const auto rings = static_cast<double>(tally.lateral_by_range_m.size());
    farthest_m = std::max(farthest_m, rings * tally.by_range.width_m);
  }
  plot.x_range = std::pair(0.0, farthest_m);
  return plot;
}

Plot recall_by_range(const Results& results) {
  constexpr double kFarthest_m = 40.0;  // beyond it there is hardly any truth
  Plot plot{.title = "Recall by range",
            .about = "One line a method: the share of the visible truth that is found, in rings of 5 m.",
            .x_label = "range, m",
            .y_label = "recall",
            .x_range = std::pair(0.0, kFarthest_m),
            .y_max = 1.0,
            .series = {}};
  plot.series = of_each(results, [](const Tally& tally) {
    std::vector<PlotPoint> points;
    for (std::size_t ring = 0; ring < tally.by_range.bins.size(); ++ring) {
      const double at_m = middle_of(ring, tally.by_range.width_m);
      if (at_m < kFarthest_m) points.push_back({at_m, tally.by_range.bins[ring].recall().value_or(kNone)});
    }
    return points;
  });
  return plot;
}

/// Of labelled sets: a plot a cell.
Plot f1_by_tolerance(const Results& results, std::size_t cell) {
  Plot plot{.title = fmt::format("{}: F1 by tolerance", results.suite.cells[cell].name),
            .about = "One line a method: F1 over all scans together, at each tolerance.",
            .x_label = "tolerance, m",
            .y_label = "F1",
            .y_max = 1.0,
            .series = {}};
  for (std::size_t i = 0; i < results.contestants.size(); ++i) {
    const eval::LabelScore& labels = results.tally(cell, i).labels;
    Series series{results.contestants[i].name, {}};
    for (const eval::ToleranceScore& at : labels.at)
      series.points.push_back({at.tolerance_m, eval::figures_of(labels, at).f1});
    plot.series.push_back(std::move(series));
  }
  return plot;
}

/// A degradation curve: a figure of each method over a condition.
Plot curve_of(const Results& results, const std::string& condition, const std::string& figure,
              const std::string& name) {
  Plot plot{.title = fmt::format("{} by {}", name, condition),
            .about = fmt::format("One line a method: {} as the condition changes: {}.", name, condition),
            .x_label = condition,
            .y_label = name,
            .y_max = 1.0,
            .series = {}};
  for (std::size_t i = 0; i < results.contestants.size(); ++i) {
    Series series{results.contestants[i].name, {}};
    for (std::size_t cell = 0; cell < results.suite.cells.size(); ++cell) {
      if (results.suite.cells[cell].condition != condition) continue;
      const Figures figures = figures_of(results.suite, results.contestants[i], results.tally(cell, i));
      series.points.push_back({results.suite.cells[cell].value, value_of(figures, figure).value_or(kNone)});
    }
    plot.series.push_back(std::move(series));
  }
  return plot;
}

/// Points beside each other at a cell's place, so that no whisker hides another.
double place_of(std::size_t cell, std::size_t series, std::size_t count) {
  return static_cast<double>(cell) +
         0.5 * ((static_cast<double>(series) + 0.5) / static_cast<double>(count) - 0.5);
}

Series successes_of(const Results& results, std::size_t contestant, std::size_t count) {
  Series series{results.contestants[contestant].name, {}, false};
  for (std::size_t cell = 0; cell < results.suite.cells.size(); ++cell) {
    const Figures figures =
        figures_of(results.suite, results.contestants[contestant], results.tally(cell, contestant));
    const auto low = value_of(figures, "success_low");
    const auto high = value_of(figures, "success_high");
    if (!low || !high) continue;
    series.points.push_back({place_of(cell, contestant, count), value_of(figures, "success").value_or(kNone),
                             std::pair(*low, *high)});
  }
  return series;
}

void add_printed_successes(const Suite& suite, Plot& plot, std::size_t count) {
  for (const Printed& printed : suite.printed) {
    auto series = std::ranges::find(plot.series, printed.by, &Series::name);
    if (series == plot.series.end()) series = plot.series.insert(series, {printed.by, {}, false});
    const auto cell = std::ranges::find(suite.cells, printed.cell, &Cell::name) - suite.cells.begin();
    for (const auto& [name, value] : printed.figures) {
      if (name != "success") continue;
      const auto index = static_cast<std::size_t>(series - plot.series.begin());
      series->points.push_back({place_of(static_cast<std::size_t>(cell), index, count), value});
    }
  }
}

Plot success_by_cell(const Results& results) {
  Plot plot{
      .title = "Success of frames",
      .about =
          "Share of frames that are a success, with the interval that holds it with 95 %, beside what the "
          "papers print.",
      .x_label = "frames",
      .y_label = "share",
      .y_max = 1.0,
      .series = {}};
  std::size_t count = results.contestants.size();
  std::vector<std::string> others;
  for (const Printed& printed : results.suite.printed) {
    if (std::ranges::find(others, printed.by) == others.end()) others.push_back(printed.by);
  }
  count += others.size();
  for (const Cell& cell : results.suite.cells) plot.x_names.push_back(cell.name);
  for (std::size_t i = 0; i < results.contestants.size(); ++i)
    plot.series.push_back(successes_of(results, i, count));
  add_printed_successes(results.suite, plot, count);
  return plot;
}

std::vector<std::string> conditions_of(const Suite& suite) {
  std::vector<std::string> conditions;
  for (const Cell& cell : suite.cells) {
    if (!cell.condition.empty() && std::ranges::find(conditions, cell.condition) == conditions.end())
      conditions.push_back(cell.condition);
  }
  return conditions;
}

}  // namespace

std::vector<Plot> plots_of(const Results& results) {
  std::vector<Plot> plots;
  const Suite& suite = results.suite;
  for (const std::string& condition : conditions_of(suite)) {
    if (suite.judged.boundaries) plots.push_back(curve_of(results, condition, "f1", "F1"));
    if (!suite.judged.corners) continue;
    plots.push_back(curve_of(results, condition, "m1", "M1"));
    plots.push_back(curve_of(results, condition, "m2", "M2"));
  }
  for (std::size_t cell = 0; cell < suite.cells.size(); ++cell) {
    if (is_labelled(suite.cells[cell])) plots.push_back(f1_by_tolerance(results, cell));
  }
  if (suite.judged.boundaries && !std::ranges::any_of(suite.cells, is_labelled)) {
    if (conditions_of(suite).empty()) plots.push_back(success_by_cell(results));
    plots.push_back(precision_recall(results));
    plots.push_back(error_by_range(results));
    plots.push_back(recall_by_range(results));
  }
  return plots;
}

}  // namespace verge::study
