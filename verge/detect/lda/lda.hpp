// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "verge/core/fields.hpp"
#include "verge/detect/detector.hpp"

namespace verge::detect {

/// Settings of Lda. Its model are the weights and the threshold: what `verge train lda` writes is a file of
/// settings. "A2.3" is the reconstruction in docs/methods.md; what it leaves open is "ours".
struct LdaConfig {
  // Height gate and region of interest, as paper 3 has them for both methods
  double height_max_m = 0.5;
  double lateral_max_m = 20.0;
  double forward_max_m = 23.0;
  double range_min_m = 1.5;

  // Windows along the scan line
  std::int64_t window = 21;
  double gap_min_m = 1.0;
  double gap_factor = 3.0;

  // The model: verge train lda --drives 10 --scans 10
  double weight_step = 290.8274892378975;
  double weight_deviation = -251.1470479452937;
  double weight_slope = 8.885889994235702;
  double weight_compression = 11.59420649964672;
  double weight_bend = -1178.5905449832903;
  double threshold = 16.55901463588927;

  // Line or quadratic
  double reject_sigma = 2.5;
  std::int64_t points_min = 5;
  double line_residual_m = 0.15;
  double sample_step_m = 0.5;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor&& visit) {
    visit(self.height_max_m,
          {"height_max_m", "m", 0.05, 10.0, "points higher above the road are dropped", "ours"});
    visit(self.lateral_max_m,
          {"lateral_max_m", "m", 1.0, 100.0, "region of interest to the left and right", "ours"});
    visit(self.forward_max_m,
          {"forward_max_m", "m", 1.0, 200.0, "region of interest ahead and behind", "ours"});
    visit(self.range_min_m, {"range_min_m", "m", 0.0, 10.0, "nearer returns are of the own vehicle", "ours"});
    visit(self.window,
          {"window", "1", 3, 99, "returns in a window; a model holds for the window that it was trained with",
           "A2.3"});
    visit(self.gap_min_m, {"gap_min_m", "m", 0.01, 5.0,
                           "no window spans a gap wider than this; on a kerb that runs along the beams "
                           "returns are half a metre apart",
                           "ours"});
    visit(self.gap_factor,
          {"gap_factor", "1", 0.0, 100.0, "nor one wider than this many point spacings", "ours"});
    visit(self.weight_step,
          {"weight_step", "1/m", -1e9, 1e9, "model: weight of the greatest less the least height of a window",
           "A2.3; verge train lda"});
    visit(self.weight_deviation, {"weight_deviation", "1/m", -1e9, 1e9,
                                  "model: weight of the heights' deviation", "A2.3; verge train lda"});
    visit(self.weight_slope,
          {"weight_slope", "1", -1e9, 1e9,
           "model: weight of the size of the slope of height over lateral place", "A2.3; verge train lda"});
    visit(self.weight_compression, {"weight_compression", "1", -1e9, 1e9,
                                    "model: weight of how much nearer the returns are than the road's plane",
                                    "A2.3; verge train lda"});
    visit(self.weight_bend,
          {"weight_bend", "1/m", -1e9, 1e9,
           "model: weight of the size of the heights' mean second difference", "A2.3; verge train lda"});
    visit(self.threshold, {"threshold", "1", -1e9, 1e9,
                           "model: a window is an edge where the weighted sum is greater; higher finds fewer",
                           "A2.3; verge train lda"});
    visit(self.reject_sigma, {"reject_sigma", "1", 1.0, 10.0,
                              "points farther off than so many deviations are left out, and the rest fitted "
                              "again",
                              "A2.3"});
    visit(self.points_min, {"points_min", "1", 3, 1000, "least points of a boundary", "ours"});
    visit(self.line_residual_m,
          {"line_residual_m", "m", 0.01, 2.0,
           "straight if the 95th percentile of the residuals is not above this, else a quadratic", "ours"});
    visit(self.sample_step_m,
          {"sample_step_m", "m", 0.05, 5.0, "spacing of the points of a boundary", "ours"});
  }
};

/// The baseline that paper 3 compares with: "the linear discriminant analysis (LDA) classification method" of
/// its reference [9] (Liu, Tang, Ren, J. Huazhong Univ. of Sci. and Tech. (Nat. Sci.), 2011), which is not to
/// be found: a RECONSTRUCTION from that sentence and from what such methods do. Windows along each scan line,
/// five features of each, a linear discriminant trained on labelled windows; on each scan line and side the
/// nearest window of an edge; and one line or quadratic a side.
class Lda final : public Detector {
 public:
  using Config = LdaConfig;

  Lda();
  /// Throws std::invalid_argument where a value is outside its range, or the window is even.
  explicit Lda(const Config& config);

  /// At most one boundary a side, left first, in the sensor's frame, rear end first. Uses scan.mount, or
  /// estimates it. Trace layers: points "low", "edge windows" (middles of the windows that are classified as
  /// an edge; group = quadrant a..d as 0..3), "candidates" (the one of each scan line), "clusters" (those
  /// that were fitted to; group = boundary); lines "fit"; values "w" (the weights, then the threshold c).
  [[nodiscard]] Scene process(const Scan& scan, Trace* trace = nullptr) override;
  [[nodiscard]] Order order() const override { return Order::kIndependent; }

 private:
  Config config_;
};

}  // namespace verge::detect
