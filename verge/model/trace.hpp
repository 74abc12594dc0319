// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "verge/core/vec.hpp"

namespace verge {

/// Every intermediate of a method under its paper name, in the order in which the method made it.
/// Pictures and the viewer show them as layers. Coordinates are in the scan's sensor frame, metres.
struct Trace {
  struct Points {
    std::string name;
    std::vector<Vec3> points;
    std::vector<int> group;  ///< A cluster or region for each point; empty where there is none.
  };
  struct Line {
    std::string name;
    std::vector<Vec3> points;
  };
  struct Values {
    std::string name;
    std::vector<double> values;
  };
  /// What a raster's columns or rows stand for, evenly spaced.
  struct Axis {
    std::string name;
    std::string unit;    ///< "m", "deg", ...
    double first = 0.0;  ///< At the centre of the first column or row.
    double step = 1.0;   ///< From each to the next; may be negative, not 0.
  };
  /// A picture made of numbers: a bird's-eye picture (y to the left along its rows, x ahead along its
  /// columns), or one over what else the axes say.
  struct Raster {
    std::string name;
    std::size_t rows = 0;
    std::size_t cols = 0;
    std::vector<float> values;  ///< rows x cols, row after row, the uppermost first.
    Axis x;                     ///< What the columns stand for.
    Axis y;                     ///< What the rows stand for.
  };

  std::vector<Points> points;
  std::vector<Line> lines;
  std::vector<Values> values;
  std::vector<Raster> rasters;

  /// The first layer of that name, or null.
  [[nodiscard]] const Points* find_points(std::string_view name) const;
  [[nodiscard]] const Line* find_line(std::string_view name) const;
  [[nodiscard]] const Values* find_values(std::string_view name) const;
  [[nodiscard]] const Raster* find_raster(std::string_view name) const;
};

}  // namespace verge
