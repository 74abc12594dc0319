// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "verge/emit/bev_view.hpp"
#include "verge/emit/canvas.hpp"

namespace verge::emit {

/// What the sign of a legend's entry looks like.
enum class LegendSign { kDot, kGroups, kHeights, kLine, kDashedLine, kDottedLine };

struct LegendEntry {
  LegendSign sign = LegendSign::kDot;
  Colour colour;
  std::string text;
};
using Legend = std::vector<LegendEntry>;

/// The colour of a side's boundaries: left and right can be told apart with any colour vision, and neither is
/// in the colour map of the heights.
[[nodiscard]] Colour side_colour(Side side);

/// Colours for the heights of a scan's points above the road.
class HeightScale {
 public:
  /// Without a mount, heights count from the lowest twentieth of the points.
  HeightScale(const Scan& scan, const BevPlot::Config& config);

  [[nodiscard]] double height(Vec3 p_sensor) const { return level_.to_level(p_sensor).z - zero_m_; }
  /// The step of the scale, from 0 for the darkest on; kShades above the scale.
  [[nodiscard]] std::size_t shade(double height_m) const;
  /// Grey above the scale: what stands higher is not what a road's edge is about.
  [[nodiscard]] static Colour colour(std::size_t shade);

 private:
  static constexpr std::size_t kShades = 256;
  LevelFrame level_;
  double zero_m_ = 0.0;
  double min_m_;
  double max_m_;
};

/// Each draws its layer and, where it has something, adds its entries to the legend.
///
/// The scan lies below everything; where the trace says which points passed the height gate, the others are
/// dimmed.
void draw_scan(Canvas& canvas, const BevView& view, const HeightScale& scale, const BevContent& content,
               double ceiling_m);
/// The layers of the trace that belong under the boundaries, or those that belong on top of them.
enum class Depth { kUnder, kOver };
void draw_trace(Canvas& canvas, const BevView& view, const HeightScale& scale, const Trace& trace,
                Depth depth, Legend& legend);
void draw_boundaries(Canvas& canvas, const BevView& view, const Scene& scene, Legend& legend);
/// A disc where each corner is, in the colour of its side, with a ring of its deviation.
void draw_corners(Canvas& canvas, const BevView& view, const Scene& scene, Legend& legend);
/// Boundaries dashed, corners as crosses; those of confidence 0 (they look like one) fainter.
void draw_truth(Canvas& canvas, const BevView& view, const Scene& truth, Legend& legend);

}  // namespace verge::emit
