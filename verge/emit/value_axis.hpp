// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "verge/emit/canvas.hpp"

namespace verge::emit {

/// Where on a canvas values are drawn, pixels.
struct PlotArea {
  double left = 0.0;
  double top = 0.0;
  double width = 0.0;
  double height = 0.0;
};

/// The upright axis of a plot: round values from at most the least to at least the greatest that it was made
/// for.
class ValueAxis {
 public:
  /// Both finite. An axis of one value reaches to 1 above it.
  ValueAxis(double least, double greatest, const PlotArea& area);

  /// Where a value lies, pixels.
  [[nodiscard]] double y_of(double value) const;

  /// A line and a number at every round value.
  void draw(Canvas& canvas) const;

 private:
  PlotArea area_;
  double step_;
  double least_;
  double most_;
};

}  // namespace verge::emit
