// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "verge/core/fields.hpp"
#include "verge/detect/detector.hpp"
#include "verge/detect/reading.hpp"
#include "verge/fit/knots.hpp"

namespace verge::detect {

/// How gradient points are parted into clusters once K is known.
enum class Clustering : std::uint8_t {
  kRuns,    ///< The K gap-separated runs themselves.
  kKMeans,  ///< k-means from the means of the K runs, as the paper says; it parts long runs and joins near
            ///< ones.
};

/// By what a boundary is held to be straight.
enum class StraightRule : std::uint8_t {
  kResidual,  ///< The 95th percentile of the distances from the straight line.
  kBic,       ///< Bayesian information criterion: does the B-spline pay for its control points?
};

/// How a boundary that is not straight becomes a B-spline.
enum class SplineKind : std::uint8_t {
  kKeyPoints,     ///< Through key points, as the paper does.
  kLeastSquares,  ///< Near all points, with few control points.
};

}  // namespace verge::detect

namespace verge {
template <>
inline constexpr std::array enum_names<detect::Clustering> =
    std::to_array<std::string_view>({"runs", "kmeans"});
template <>
inline constexpr std::array enum_names<detect::StraightRule> =
    std::to_array<std::string_view>({"residual", "bic"});
template <>
inline constexpr std::array enum_names<detect::SplineKind> =
    std::to_array<std::string_view>({"key_points", "least_squares"});
template <>
inline constexpr std::array enum_names<fit::KnotPlacement> =
    std::to_array<std::string_view>({"averaged", "uniform"});
}  // namespace verge

namespace verge::detect {

/// Settings of Gradient. "P3" is the paper below; what it leaves open is "ours", chosen on every second scan
/// of the public sets (docs/results.md says which).
struct GradientConfig {
  Reading reading = Reading::kFixed;
  Clustering clustering = Clustering::kKMeans;

  // II-1 (1): height gate and region of interest
  double height_max_m = 2.0;
  double lateral_max_m = 20.0;
  double forward_max_m = 30.0;
  double range_min_m = 1.5;

  // II-1 (2): gradient
  double before_m = 1.3;
  double after_m = 0.3;
  double rise_min_m = 0.03;
  double rise_max_m = 0.35;
  double noise_factor = 3.0;

  // II-1 (3): K and clusters
  double gap_min_m = 0.8;
  double gap_factor = 3.0;
  double climb_m = 0.2;
  std::int64_t points_min = 3;
  double link_min_m = 0.8;
  double link_factor = 2.5;
  double link_max_m = 10.0;
  double link_lateral_m = 0.2;
  std::int64_t link_skip = 2;
  std::int64_t layers_min = 3;
  double join_cosine = 0.75;
  double obstacle_m = 1.0;
  double wall_length_m = 5.0;

  // III: line or B-spline
  StraightRule straight_by = StraightRule::kResidual;
  double line_residual_m = 0.15;
  SplineKind spline = SplineKind::kKeyPoints;
  fit::KnotPlacement knots = fit::KnotPlacement::kAveraged;
  double spline_span_m = 3.0;
  double spline_penalty = 0.1;
  double key_window_m = 1.0;
  double sample_step_m = 0.5;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor&& visit) {
    visit(self.reading, {"reading", "", 0, 0, "fixed, or paper: the printed text where it can run", "P3"});
    visit(self.clustering,
          {"clustering", "", 0, 0, "runs, or kmeans from the runs' means (reading = fixed)", "P3 II-1 (3)"});
    visit(self.height_max_m,
          {"height_max_m", "m", 0.05, 10.0,
           "points higher above the road are dropped; above 1 m, vehicles stay visible as obstacles",
           "P3 II-1 (1); value ours"});
    visit(self.lateral_max_m, {"lateral_max_m", "m", 1.0, 100.0, "region of interest to the left and right",
                               "P3 Fig. 2; value ours"});
    visit(self.forward_max_m,
          {"forward_max_m", "m", 1.0, 200.0, "region of interest ahead and behind", "P3 Fig. 2; value ours"});
    visit(self.range_min_m, {"range_min_m", "m", 0.0, 10.0, "nearer returns are of the own vehicle", "ours"});
    visit(self.before_m, {"before_m", "m", 0.2, 5.0,
                          "length of ring on the road's side whose slope is the road's own", "ours"});
    visit(self.after_m,
          {"after_m", "m", 0.1, 3.0, "length of ring whose mean height is held against that slope", "ours"});
    visit(self.rise_min_m, {"rise_min_m", "m", 0.005, 1.0,
                            "least rise of a boundary; lower finds lower kerbs and more false ones",
                            "P3 II-1 (2); value ours"});
    visit(self.rise_max_m, {"rise_max_m", "m", 0.05, 5.0,
                            "a higher rise is an obstacle: the road ends, but it is no kerb", "ours"});
    visit(self.noise_factor, {"noise_factor", "1", 0.0, 20.0,
                              "a rise must exceed its own standard error by this factor", "ours"});
    visit(self.gap_min_m,
          {"gap_min_m", "m", 0.01, 5.0, "d_threshold = m: least gap that parts two clusters of a scan line",
           "P3 II-1 (3); value ours"});
    visit(self.gap_factor, {"gap_factor", "1", 0.0, 100.0, "m is at least this many point spacings", "ours"});
    visit(self.climb_m,
          {"climb_m", "m", 0.0, 5.0,
           "a gap along the beams parts a scan line only where it climbs or falls more than this", "ours"});
    visit(self.points_min,
          {"points_min", "1", 1, 1000, "least points of a cluster (the paper's certain threshold)",
           "P3 II-1 (3); value ours"});
    visit(self.link_min_m,
          {"link_min_m", "m", 0.05, 10.0, "m between boundary points of adjacent layers, at least",
           "P3 II-1 (3), adjacent layer; value ours"});
    visit(self.link_factor, {"link_factor", "1", 0.1, 20.0,
                             "m between adjacent layers in spacings of their rings on the ground", "ours"});
    visit(self.link_max_m,
          {"link_max_m", "m", 0.5, 100.0,
           "and at most: far out, where rings lie wide apart, more would join what does not belong together",
           "ours"});
    visit(self.link_lateral_m,
          {"link_lateral_m", "m", 0.01, 5.0,
           "how far a cluster's next point may lie off its direction, plus a fifth of the step", "ours"});
    visit(self.link_skip, {"link_skip", "1", 0, 20, "layers that a cluster may miss in a row", "ours"});
    visit(self.layers_min, {"layers_min", "1", 2, 64, "least layers of a boundary", "ours"});
    visit(self.join_cosine,
          {"join_cosine", "1", -1.0, 1.0,
           "a front and a rear boundary join where their directions agree this well", "ours"});
    visit(self.obstacle_m,
          {"obstacle_m", "m", 0.3, 10.0, "returns this high right above a rise make it an obstacle", "ours"});
    visit(self.wall_length_m, {"wall_length_m", "m", 0.0, 100.0,
                               "obstacles in line over this length are a wall and bound the road", "ours"});
    visit(self.straight_by,
          {"straight_by", "", 0, 0,
           "residual, or bic: what a B-spline gains must be worth its control points (reading = fixed)",
           "P3 III, adaptive selection; rules ours"});
    visit(self.line_residual_m,
          {"line_residual_m", "m", 0.01, 2.0,
           "straight if the 95th percentile of the residuals is not above this, else a B-spline "
           "(straight_by = residual)",
           "P3 III; value ours"});
    visit(self.spline,
          {"spline", "", 0, 0, "key_points: through them; least_squares: near all points (reading = fixed)",
           "P3 III-2 to III-5; ours"});
    visit(self.knots, {"knots", "", 0, 0,
                       "averaged, or uniform (non-periodic); averaged where uniform ones determine no curve",
                       "P3 III-4, Eq. (5); its title"});
    visit(self.spline_span_m,
          {"spline_span_m", "m", 0.5, 50.0,
           "knot spacing of the smoothing curve from which key points are taken", "ours"});
    visit(self.spline_penalty, {"spline_penalty", "1", 0.0, 1e6, "its stiffness", "ours"});
    visit(self.key_window_m,
          {"key_window_m", "m", 0.1, 20.0, "length over which the curvature of key points is measured",
           "P3 III-2; value ours"});
    visit(self.sample_step_m,
          {"sample_step_m", "m", 0.05, 5.0, "spacing of the points of a boundary", "ours"});
  }
};

/// Road boundaries from a multi-line lidar, after Zhong et al., "Road boundary detection algorithm based on
/// multi-line 3D laser radar", IJEART 3(8), 2017 (P3): height gate, four quadrants, gradient along each scan
/// line, K from gaps, clusters with a size threshold, and a straight line by least squares or a cubic
/// B-spline through curvature key points.
///
/// The quadrants tie the method to the road's direction: it needs a road that runs within about 45 degrees of
/// the vehicle's axis.
class Gradient final : public Detector {
 public:
  using Config = GradientConfig;

  Gradient();
  /// Throws std::invalid_argument where a value is outside its range.
  explicit Gradient(const Config& config);

  /// Boundaries in the sensor's frame, rear end first. Uses scan.mount, or estimates it. Trace layers: points
  /// "low", "gradient points" (group = quadrant a..d as 0..3), "candidates" (likewise), "clusters" (group =
  /// boundary), "key points" (likewise); lines "fit"; values "K" (a number for each scan line and region)
  /// and, for each B-spline, "P" (control points, x and y by turns, level frame), "s" and "kappa" (place
  /// along it, m, and curvature, 1/m, of the points that key points were chosen from), "key s" (place of the
  /// key points), "u" and "U".
  [[nodiscard]] Scene process(const Scan& scan, Trace* trace = nullptr) override;
  [[nodiscard]] Order order() const override { return Order::kIndependent; }

 private:
  Config config_;
};

}  // namespace verge::detect
