// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

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

  std::vector<Points> points;
  std::vector<Line> lines;
  std::vector<Values> values;

  /// The first layer of that name, or null.
  [[nodiscard]] const Points* find_points(std::string_view name) const;
  [[nodiscard]] const Line* find_line(std::string_view name) const;
  [[nodiscard]] const Values* find_values(std::string_view name) const;
};

}  // namespace verge
