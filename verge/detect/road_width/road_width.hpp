// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string_view>

#include "verge/core/fields.hpp"
#include "verge/detect/detector.hpp"

namespace verge::detect {

/// How corners are found on the four lines.
enum class CornerReading : std::uint8_t {
  kCombined,  ///< All lines together show where the kerb runs along the way; ours.
  kFixed,     ///< The paper's states, its misprints put right and gaps filled; docs/methods.md lists each.
  kPaper,     ///< As printed.
};

}  // namespace verge::detect

namespace verge {
template <>
inline constexpr std::array enum_names<detect::CornerReading> =
    std::to_array<std::string_view>({"combined", "fixed", "paper"});
}  // namespace verge

namespace verge::detect {

/// Settings of RoadWidth. "P1" is the paper below.
struct RoadWidthConfig {
  CornerReading reading = CornerReading::kCombined;

  // Fig. 1, 2: four lines
  double nearest_rad = 1.308996938995747;  // 75 degrees
  double span_rad = 0.05585053606381854;   // 3.2 degrees
  double side_rad = 1.0471975511965976;    // 60 degrees

  // Steps 1 to 7 of a road line
  std::int64_t neighbours = 0;
  double neighbours_rad = 0.06544984694978735;  // 3.75 degrees
  double y_thres_m2 = 0.008;
  double noise_factor = 2.0;
  double x_thres_m2 = 0.01;
  std::int64_t bridge = 3;
  double obstacle_m = 0.4;
  double reach_m = 8.0;

  // Steps 1 to 7 of corners
  double ds_thres_m = 1.0;
  double dd_thres_m = 1.0;
  std::int64_t k_thres = 2;
  std::int64_t lag = 8;
  double lag_m = 1.5;
  std::int64_t misses = 1;
  std::int64_t pairs = 0;
  double widened_m = 0.2;

  // Corners of all lines together
  double straight_m = 8.0;
  double beyond_m = 0.1;
  double standing_m = 0.25;
  double opening_m = 2.9;
  double bay_m = 2.6;
  double wide_return_m = 2.5;
  double widest_return_m = 12.0;
  double turned_m = 0.25;

  [[nodiscard]] bool is_printed() const { return reading == CornerReading::kPaper; }

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor&& visit) {
    visit(self.reading,
          {"reading", "", 0, 0,
           "combined: all lines together; fixed: the paper's states; paper: these as printed", "P1, ours"});
    visit(self.nearest_rad,
          {"nearest_rad", "rad", 0.1, 1.55,
           "angle from the vertical of the nearest of four lines, where a denser sensor's rings "
           "stand in for a four-layer scanner's",
           "P1, theta"});
    visit(self.span_rad, {"span_rad", "rad", 0.001, 0.5, "from the nearest to the farthest of these lines",
                          "P1, Delta theta"});
    visit(self.side_rad,
          {"side_rad", "rad", 0.1, 1.5, "lines are looked at so far to the left and to the right", "ours"});
    visit(self.neighbours, {"neighbours", "1", 0, 1000,
                            "K: points of a window; 0: as many as neighbours_rad holds", "P1 Step 2"});
    visit(self.neighbours_rad,
          {"neighbours_rad", "rad", 0.001, 0.5, "width of a window: 15 points at 0.25 degrees, 8 at 0.5",
           "P1 Step 2; value ours"});
    visit(self.y_thres_m2,
          {"y_thres_m2", "m^2", 1e-6, 1.0, "Y_thres: an edge's msdv_y is greater", "P1 Step 3; value ours"});
    visit(self.noise_factor, {"noise_factor", "1", 0.0, 100.0,
                              "and greater than the line's own noise, as a mean square, times this (not as "
                              "printed)",
                              "ours"});
    visit(self.x_thres_m2,
          {"x_thres_m2", "m^2", 1e-6, 1.0, "X_thres: an edge's msdv_dx is less", "P1 Step 3; value ours"});
    visit(self.bridge,
          {"bridge", "1", 0, 100, "so many points in a row may differ from the road (not as printed)",
           "P1 trait (2); value ours"});
    visit(self.obstacle_m,
          {"obstacle_m", "m", 0.05, 10.0, "a higher face is a wall or a vehicle (not as printed)",
           "P1 trait (1); value ours"});
    visit(self.reach_m, {"reach_m", "m", 1.0, 100.0,
                         "road lines end so far to the left and to the right at the most", "ours"});
    visit(self.ds_thres_m,
          {"ds_thres_m", "m", 0.05, 20.0,
           "DS_thres: so much longer is the first line in a corner than before", "P1 Step 4; value ours"});
    visit(self.dd_thres_m, {"dd_thres_m", "m", 0.05, 20.0,
                            "DD_thres: so much longer is the first line than the last where a corner begins",
                            "P1 Step 6; value ours"});
    visit(self.k_thres, {"k_thres", "1", 0, 100, "K_thres: a corner is found after more scans than this",
                         "P1 Step 5; value ours"});
    visit(self.lag, {"lag", "1", 1, 64, "h: scans back to the length that is compared (reading = paper)",
                     "P1 Step 4; value ours"});
    visit(self.lag_m, {"lag_m", "m", 0.1, 20.0,
                       "h as a way: the lag is as many scans as it takes (reading = fixed)", "ours"});
    visit(self.misses, {"misses", "1", 0, 10,
                        "scans in a row that may fail the second comparison (reading = fixed)", "ours"});
    visit(self.pairs, {"pairs", "1", 0, 4,
                       "so many of the pairs of lines 1-4, 1-3, 1-2, 2-4 must be in a corner; 0: 1-4 alone "
                       "(reading = fixed)",
                       "P1 abstract"});
    visit(self.widened_m, {"widened_m", "m", 0.01, 5.0,
                           "a line so much longer than the straight road's has begun to widen", "ours"});
    visit(self.straight_m, {"straight_m", "m", 4.0, 25.0,
                            "the kerb that has been passed so far back says how it goes on (reading = "
                            "combined, as all below)",
                            "ours"});
    visit(self.beyond_m,
          {"beyond_m", "m", 0.02, 1.0,
           "an edge so far beyond the straight kerb, and beyond 3 sigma, is not of it", "ours"});
    visit(self.opening_m,
          {"opening_m", "m", 0.5, 20.0,
           "a longer opening is a side road: driveways and gaps are up to 2.5 m wide", "P1; ours"});
    visit(self.bay_m,
          {"bay_m", "m", 0.1, 10.0, "if it is deeper than this: parking bays are 2 to 2.5 m deep", "ours"});
    visit(self.wide_return_m,
          {"wide_return_m", "m", 0.5, 10.0,
           "a kerb that turns away with such a radius or more leads into a side road", "ours"});
    visit(self.widest_return_m,
          {"widest_return_m", "m", 1.0, 30.0, "and no greater radius than this", "ours"});
    visit(self.turned_m, {"turned_m", "m", 0.05, 5.0, "once it is so far beyond the straight kerb", "ours"});
  }
};

/// Road corners from a four-layer scanner, after Liu, Feng, Li, Zhang, "Corner Detection for Intelligent
/// Vehicles Based on a Four-Layer Radar" (P1): the road line of each layer by the spread of its points, the
/// road's width from scan to scan, and states that tell a corner by the farthest line's widening before the
/// nearest one's. The default reading goes on from the lines in its own way: it puts the ends of all four
/// along the way, where the kerb they show either turns away or does not.
///
/// It needs a road that runs along the level frame's x axis (hypothesis 1), and poses (Scan::T_world_sensor):
/// without them `combined` does as `fixed`, whose lag is then `lag` scans and whose corners lie where the
/// first line does, as long as it is in them. Of a denser sensor, the rings that meet the road nearest to
/// where the four lines would are taken.
class RoadWidth final : public Detector {
 public:
  using Config = RoadWidthConfig;

  RoadWidth();
  /// Throws std::invalid_argument where a value is outside its range.
  explicit RoadWidth(const Config& config);
  RoadWidth(const RoadWidth&) = delete;
  RoadWidth& operator=(const RoadWidth&) = delete;
  ~RoadWidth() override;

  /// Corners from the scan in which they are found until their exit is passed, each with its id; and as
  /// boundaries the edges of the four lines (combined: the feet of the kerbs), one polyline a side, where two
  /// lines or more have one. Uses scan.mount, or estimates it. Trace layers: points "line 1" (the first,
  /// farthest) to "line 4" (the last); "edges" (group = line); values "L" (road lengths by line), "middle is
  /// road" (0 or 1 by line: hypothesis 1); and of the states "first comparison", "second comparison" and "K"
  /// (each with its threshold behind it), "CCS" (0 or 1), "h".
  [[nodiscard]] Scene process(const Scan& scan, Trace* trace = nullptr) override;
  [[nodiscard]] Order order() const override { return Order::kSequential; }

 private:
  struct State;

  Config config_;
  std::unique_ptr<State> state_;
};

}  // namespace verge::detect
