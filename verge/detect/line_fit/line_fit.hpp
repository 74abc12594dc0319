// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "verge/core/fields.hpp"
#include "verge/detect/detector.hpp"
#include "verge/detect/line_fit/kerb_pieces.hpp"
#include "verge/detect/line_fit/layer_points.hpp"
#include "verge/detect/line_fit/objects.hpp"
#include "verge/detect/reading.hpp"
#include "verge/raster/edges.hpp"

namespace verge::detect {

/// What is put through the points of an edge.
enum class EdgeEstimator : std::uint8_t {
  kRobust,  ///< A line by orthogonal least squares, outliers weighed down; a cubic where none fits; ours.
  kLeastSquares,  ///< A line by ordinary least squares (P2 III-C).
  kPolynomial,    ///< A polynomial by least squares (P2 V-C).
  kTheilSen,      ///< A line by Theil and Sen (P2 III-B).
  kHough,         ///< Squares, edges, Hough lines, each put through its points again (P2 III-A).
};

/// Which points make one edge.
enum class EdgeGrouping : std::uint8_t {
  kKerb,      ///< The returns of a side's kerb; ours.
  kClusters,  ///< Each cluster of points between breakpoints.
  kKMeans,    ///< Each of k clusters by k-means (P2 IV).
  kNone,      ///< All points.
};

}  // namespace verge::detect

namespace verge {
template <>
inline constexpr std::array enum_names<detect::EdgeEstimator> =
    std::to_array<std::string_view>({"robust", "least_squares", "polynomial", "theil_sen", "hough"});
template <>
inline constexpr std::array enum_names<detect::EdgeGrouping> =
    std::to_array<std::string_view>({"kerb", "clusters", "kmeans", "none"});
}  // namespace verge

namespace verge::detect {

/// Settings of LineFit. "P2" is the paper below.
struct LineFitConfig {
  Reading reading = Reading::kFixed;
  EdgeEstimator estimator = EdgeEstimator::kRobust;
  EdgeGrouping grouping = EdgeGrouping::kKerb;
  std::int64_t layer = -1;
  std::int64_t clusters = 2;
  std::int64_t degree = 3;
  double line_p95_m = 0.15;
  double along_road_max_rad = 0.35;
  double bridged_m = 1.5;

  // Hough
  double cell_m = 0.1;
  std::int64_t square_px = 5;
  raster::EdgeFilter edge_filter = raster::EdgeFilter::kNone;
  double gaussian_px = 0.0;
  std::int64_t peaks = 10;
  double peak_share = 0.3;
  double fill_gap_m = 3.0;
  double min_length_m = 4.0;
  bool max_len = false;

  line_fit::LayerPointsConfig points{};
  line_fit::KerbConfig kerb{};
  line_fit::ObjectsConfig objects{};

  [[nodiscard]] bool is_printed() const { return reading == Reading::kPaper; }

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor&& visit) {
    visit(self.reading,
          {"reading", "", 0, 0,
           "fixed: clusters first, then lines; paper: as printed, the third layer, lines through all of its "
           "points, k-means then (grouping and layer do not count)",
           "P2"});
    visit(self.estimator,
          {"estimator", "", 0, 0,
           "robust, least_squares, polynomial, theil_sen, hough: what makes an edge of points",
           "P2 III; robust: ours"});
    visit(self.grouping, {"grouping", "", 0, 0, "kerb, clusters, kmeans, none: which points make an edge",
                          "P2 IV; kerb, clusters: ours"});
    visit(self.layer, {"layer", "1", -1, 3, "the one layer that is looked at, 0 the lowest; -1: all four",
                       "P2 IV: 2 first, then the others"});
    visit(self.clusters,
          {"clusters", "1", 0, 16, "k of k-means; 0: by the silhouette, up to 16", "P2 IV: 2"});
    visit(self.degree, {"degree", "1", 1, 16,
                        "of the polynomial (reading = paper: the highest one, 16, and a specified error)",
                        "P2 V-C; value ours"});
    visit(self.line_p95_m,
          {"line_p95_m", "m", 0.001, 10.0,
           "robust: a cubic is tried where 95 % of a line's residuals are not below this", "ours"});
    visit(self.along_road_max_rad,
          {"along_road_max_rad", "rad", 0.0, 1.57,
           "an edge of the road leaves the road's direction by so much at the most", "ours"});
    visit(self.bridged_m, {"bridged_m", "m", 0.1, 50.0,
                           "an edge farther from its next return than this is bridged, not seen", "ours"});
    visit(self.cell_m, {"cell_m", "m", 0.02, 1.0, "r: a pixel's side", "P2 III-A; value ours"});
    visit(self.square_px, {"square_px", "1", 1, 31, "points are marked as squares of so many pixels a side",
                           "P2 V-A; value ours"});
    visit(self.edge_filter,
          {"edge_filter", "", 0, 0,
           "none, canny, sobel, prewitt, laplacian: what is done before the Hough transform "
           "(reading = paper: canny)",
           "P2 III"});
    visit(self.gaussian_px,
          {"gaussian_px", "1", 0.0, 10.0, "deviation of a Gaussian before that, pixels; 0: none", "ours"});
    visit(self.peaks, {"peaks", "1", 1, 100, "lines at the most", "P2 V-A; value ours"});
    visit(self.peak_share,
          {"peak_share", "1", 0.0, 1.0, "a line has this share of the points of the greatest one", "ours"});
    visit(self.fill_gap_m,
          {"fill_gap_m", "m", 0.0, 50.0, "FillGap: shorter gaps of a line are closed", "P2 V-A; value ours"});
    visit(self.min_length_m,
          {"min_length_m", "m", 0.0, 50.0, "MinLength: shorter lines are dropped", "P2 V-A; value ours"});
    visit(self.max_len, {"max_len", "", 0, 0, "the longest stretch of each line alone", "P2 V-A"});
    line_fit::LayerPointsConfig::fields(self.points, visit);
    line_fit::KerbConfig::fields(self.kerb, visit);
    line_fit::ObjectsConfig::fields(self.objects, visit);
  }
};

/// Road edges and objects from a four-layer scanner, after Duan, Valentyna, "Road Edge Detection Based On
/// Lidar Laser" (P2): returns within a range gate, of one layer or all; lines through them by Hough
/// transform, least squares, polynomials or Theil and Sen; clusters by k-means; objects told apart as "-",
/// "J" and "L". The default goes on in its own way: objects are found first, and the road's edge is where the
/// layers climb a kerb that no object stands on.
///
/// It needs a road that runs along the level frame's x axis. Of a denser sensor, the rings that meet the road
/// nearest to where a LUX's four layers would are taken.
class LineFit final : public Detector {
 public:
  using Config = LineFitConfig;

  LineFit() = default;
  /// Throws std::invalid_argument where a value is outside its range.
  explicit LineFit(const Config& config);

  /// The road's left and right edge where they are seen, objects, and the road's width where both edges are.
  /// Uses scan.mount, or estimates it. Trace layers: points "gate" (group = layer), "layer" (what lines go
  /// by), "groups" (group = edge); lines by estimator and edge as "least_squares 0", of every estimator
  /// whichever is chosen, and "edge left", "edge right"; rasters "squares", "edges", "accumulator";
  /// values "peaks" (theta in degrees, rho in pixels, count, for each); points "centroids" of k-means; lines
  /// "object 0", ...: the two seen sides of each object.
  [[nodiscard]] Scene process(const Scan& scan, Trace* trace = nullptr) override;
  [[nodiscard]] Order order() const override { return Order::kIndependent; }

 private:
  Config config_{};
};

}  // namespace verge::detect
