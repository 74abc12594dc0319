// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string_view>

#include "verge/core/fields.hpp"
#include "verge/detect/detector.hpp"
#include "verge/detect/reading.hpp"

namespace verge::detect {

/// Settings of RoadWidth. "P1" is the paper below.
struct RoadWidthConfig {
  Reading reading = Reading::kFixed;

  // Fig. 1, 2: four lines
  double nearest_rad = 1.308996938995747;  // 75 degrees
  double span_rad = 0.05585053606381854;   // 3.2 degrees
  double side_rad = 1.0471975511965976;    // 60 degrees

  // Steps 1 to 7 of a road line
  std::int64_t neighbours = 0;
  double neighbours_rad = 0.06544984694978735;  // 3.75 degrees
  double y_thres_m2 = 0.008;
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
  double widened_m = 0.2;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor&& visit) {
    visit(self.reading, {"reading", "", 0, 0, "fixed, or paper: the printed text to the letter", "P1"});
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
    visit(self.x_thres_m2,
          {"x_thres_m2", "m^2", 1e-6, 1.0, "X_thres: an edge's msdv_dx is less", "P1 Step 3; value ours"});
    visit(self.bridge,
          {"bridge", "1", 0, 100, "so many points in a row may differ from the road (reading = fixed)",
           "P1 trait (2); value ours"});
    visit(self.obstacle_m,
          {"obstacle_m", "m", 0.05, 10.0, "a higher face is a wall or a vehicle (reading = fixed)",
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
    visit(self.widened_m, {"widened_m", "m", 0.01, 5.0,
                           "a line so much longer than the straight road's has begun to widen", "ours"});
  }
};

/// Road corners from a four-layer scanner, after Liu, Feng, Li, Zhang, "Corner Detection for Intelligent
/// Vehicles Based on a Four-Layer Radar" (P1): the road line of each layer by the spread of its points, the
/// road's width from scan to scan, and states that tell a corner by the farthest line's widening before the
/// nearest one's.
///
/// It needs a road that runs along the sensor's x axis (hypothesis 1), and the way between two scans
/// (Scan::T_world_sensor) for the distance to a corner; without, the lag is `lag` scans and a corner lies
/// where the first line does. Of a denser sensor, the rings that meet the road nearest to where the four
/// lines would are taken.
class RoadWidth final : public Detector {
 public:
  using Config = RoadWidthConfig;

  RoadWidth();
  /// Throws std::invalid_argument where a value is outside its range.
  explicit RoadWidth(const Config& config);
  RoadWidth(const RoadWidth&) = delete;
  RoadWidth& operator=(const RoadWidth&) = delete;
  ~RoadWidth() override;

  /// Corners from the scan in which they are found until they are reached, each with its id; and as
  /// boundaries the edges of the four lines, one polyline a side, where two lines or more have one. Uses
  /// scan.mount but its forward axis, or estimates it. Trace layers: points "line 1" (the first, farthest) to
  /// "line 4" (the last); "edges" (group = line); values "L" (road lengths by line), "K", "CCS" (0 or 1) and
  /// "h".
  [[nodiscard]] Scene process(const Scan& scan, Trace* trace = nullptr) override;
  [[nodiscard]] Order order() const override { return Order::kSequential; }

 private:
  struct State;

  Config config_;
  std::unique_ptr<State> state_;
};

}  // namespace verge::detect
