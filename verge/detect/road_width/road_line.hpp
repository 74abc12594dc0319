// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace verge::detect::road_width {

/// A point of a layer in the picture of P1 Fig. 2, metres: the vehicle at the middle of the lower edge, x to
/// the right, y ahead.
struct PicturePoint {
  double x = 0.0;
  double y = 0.0;
};

/// What the search for the ends of a road line goes by (P1, Steps 1 to 7).
struct LineSearch {
  std::size_t neighbours = 15;  ///< K.
  double y_thres_m2 = 0.008;    ///< Y_thres, of msdv_y.
  double x_thres_m2 = 0.01;     ///< X_thres, of msdv_dx.
  bool standard = false;        ///< msdv is the root of the mean square, and thresholds are in metres.
  bool refine = true;           ///< Put the end where the window is best split into road and face.
  std::size_t bridge = 3;       ///< Points that differ from the road in a row and are still small matter.
  /// A face climbs its line over its height times this: the tangent of the layer's angle from the vertical.
  double tangent = 4.0;
  double obstacle_m = 0.4;  ///< Faces higher than this are walls and vehicles, not kerbs.
};

enum class LineEnd : std::uint8_t {
  kOpen,      ///< No edge was found: the whole side is road (Step 6).
  kEdge,      ///< The road's edge.
  kObstacle,  ///< Ended by something higher than a kerb.
};

/// One end of a road line.
struct RoadEnd {
  LineEnd kind = LineEnd::kOpen;
  std::size_t found = 0;  ///< "Point i" of Step 5: the current point when the window showed an edge; open:
                          ///< the outermost point.
  std::size_t edge = 0;   ///< The last point on the road: `found`, refined inside the window.
};

/// The road line of a layer: from its left to its right end.
struct RoadLine {
  RoadEnd left, right;
  bool middle_is_road = true;  ///< Hypothesis 1: whether the window about the middle point looks like road.
};

/// msdv_y: the mean square deviation of y about its mean, m^2. No point: 0.
[[nodiscard]] double msdv_y(std::span<const PicturePoint> window);

/// msdv_dx: the mean square deviation of the differences of x from point to point, m^2. Fewer than two
/// points: 0.
[[nodiscard]] double msdv_dx(std::span<const PicturePoint> window);

/// Steps 1 to 7 of P1 on the points of one layer, from left to right (x grows): from the point `middle` on
/// first to the left, then to the right. Points of a window that follow one another as the scanner fires
/// them are taken as neighbours. None where the layer has no point or `middle` is beyond it.
///
/// With `bridge` 0, `refine` off and `obstacle_m` infinite, this is the paper's text to the letter.
[[nodiscard]] std::optional<RoadLine> find_road_line(std::span<const PicturePoint> points, std::size_t middle,
                                                     const LineSearch& search);

/// "Road length": from the left to the right end, metres across the road, each side cut at `reach_m` from
/// the vehicle's axis.
[[nodiscard]] double road_length_m(std::span<const PicturePoint> points, const RoadLine& line,
                                   double reach_m);

}  // namespace verge::detect::road_width
