// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace verge::study {

struct PlotPoint {
  double x = 0.0;
  double y = 0.0;
  std::optional<std::pair<double, double>> between{};  ///< The interval that y lies in, as a whisker.
};

struct Series {
  std::string name;
  std::vector<PlotPoint> points;
  bool joined = true;  ///< By a line, in the order of the points.
};

/// Series in a frame with ticks and a legend.
struct Plot {
  std::string title;
  std::string about;  ///< For who cannot see it.
  std::string x_label;
  std::string y_label;
  std::vector<std::string> x_names{};                  ///< Of x = 0, 1, ...: in the place of numbers.
  std::optional<std::pair<double, double>> x_range{};  ///< None: what the points need.
  double y_min = 0.0;
  std::optional<double> y_max{};  ///< None: what the points need, up to a tick.
  std::vector<Series> series;
};

/// The plot as an <svg> element to stand in HTML: colours are CSS classes (s0, s1, ...), each series also has
/// a sign and dashes of its own. `id` is its name in the page. A point that is not finite is left out. Empty
/// where there is no point at all.
[[nodiscard]] std::string to_svg(const Plot& plot, const std::string& id);

/// What the classes mean, in light and in dark; a style sheet.
[[nodiscard]] std::string plot_style();

}  // namespace verge::study
