// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/detect/gradient/gradient.hpp"

#include <utility>
#include <vector>

#include "verge/core/field_io.hpp"
#include "verge/detect/gradient/boundaries.hpp"
#include "verge/detect/gradient/candidates.hpp"
#include "verge/detect/gradient/denoise.hpp"
#include "verge/detect/gradient/gradient_points.hpp"
#include "verge/detect/gradient/obstacles.hpp"
#include "verge/detect/gradient/recorder.hpp"
#include "verge/detect/gradient/regions.hpp"

namespace verge::detect {
namespace {

using namespace gradient;  // NOLINT(google-build-using-namespace): the method's own steps, all of them

/// II-1 (2): the gradient points of every layer.
std::vector<GradientPoints> all_gradient_points(const std::vector<Layer>& layers,
                                                const GradientConfig& config) {
  const bool printed = config.reading == Reading::kPaper;
  std::vector<GradientPoints> points;
  for (const Layer& layer : layers) {
    points.push_back(printed ? gradient_points_as_printed(layer, config) : gradient_points(layer, config));
  }
  return points;
}

/// II-1 (3): K and the clusters of every layer.
std::vector<LayerClusters> all_clusters(const std::vector<Layer>& layers,
                                        const std::vector<GradientPoints>& points,
                                        const GradientConfig& config) {
  std::vector<LayerClusters> clusters;
  for (std::size_t i = 0; i < layers.size(); ++i)
    clusters.push_back(cluster_layer(layers[i], points[i], config));
  return clusters;
}

/// II-1 (3), fixed reading: boundary points of adjacent layers linked, front and rear joined, noise dropped.
std::vector<Strand> denoise(const std::vector<Layer>& layers, const std::vector<GradientPoints>& points,
                            const std::vector<LayerClusters>& clusters, const Obstacles& obstacles,
                            double height_m, const GradientConfig& config, Recorder& record) {
  std::vector<Chain> chains;
  for (const Quadrant region : kQuadrants) {
    std::vector<Candidate> candidates;
    for (std::size_t i = 0; i < layers.size(); ++i) {
      if (layers[i].region != region) continue;
      const auto candidate = first_outward(layers[i], points[i], clusters[i], obstacles, config);
      if (candidate) candidates.push_back(*candidate);
    }
    record.candidates(region, candidates);
    for (Chain& chain : link_layers(region, candidates, height_m, config)) chains.push_back(std::move(chain));
  }
  std::vector<Strand> strands = join_front_and_rear(chains, false, config);
  for (Strand& right : join_front_and_rear(chains, true, config)) strands.push_back(std::move(right));
  return strands;
}

/// III, paper reading: all points of a side's clusters make one boundary.
std::vector<Fitted> fit_sides_as_printed(const std::vector<Layer>& layers,
                                         const std::vector<GradientPoints>& points,
                                         const std::vector<LayerClusters>& clusters,
                                         const GradientConfig& config) {
  std::vector<Fitted> sides;
  for (const bool right : {false, true}) {
    std::vector<Vec3> side;
    for (std::size_t i = 0; i < layers.size(); ++i) {
      if (is_right(layers[i].region) != right) continue;
      for (const std::vector<std::size_t>& cluster : clusters[i].clusters) {
        for (const std::size_t k : cluster) side.push_back(layers[i].points[points[i].index[k]]);
      }
    }
    if (auto fitted = fit_side_as_printed(side, right, config)) sides.push_back(*std::move(fitted));
  }
  return sides;
}

/// The boundaries back in the sensor's frame, numbered from 0, left ones first.
Scene scene_of(const Scan& scan, const LevelFrame& frame, std::vector<Fitted> fitted) {
  Scene scene;
  scene.frame = scan.frame;
  scene.stamp_ns = scan.stamp_ns;
  scene.frame_id = scan.frame_id;
  for (Fitted& f : fitted) {
    f.boundary.id = static_cast<int>(scene.boundaries.size());
    for (Vec3& p : f.boundary.points) p = frame.to_sensor(p);
    scene.boundaries.push_back(std::move(f.boundary));
  }
  return scene;
}

}  // namespace

Gradient::Gradient() = default;
Gradient::Gradient(const Config& config) : config_(config) { check_fields(config_); }

Scene Gradient::process(const Scan& scan, Trace* trace) {
  const Mount mount = scan.mount ? *scan.mount : estimate_mount(scan).mount;
  const LevelFrame frame(mount);
  Recorder record(trace, frame);

  const auto low = height_gate(scan, frame, config_);           // II-1 (1)
  const auto layers = split_quadrants(low);                     // II-1 (2), regions a..d
  const auto points = all_gradient_points(layers, config_);     // II-1 (2)
  const auto clusters = all_clusters(layers, points, config_);  // II-1 (3), K and clusters
  record.layers(low, layers, points, clusters);
  std::vector<Fitted> fitted;
  if (config_.reading == Reading::kPaper) {
    fitted = fit_sides_as_printed(layers, points, clusters, config_);  // III
  } else {
    const Obstacles obstacles(low, config_);
    const auto strands =
        denoise(layers, points, clusters, obstacles, mount.height_m, config_, record);  // II-1 (3)
    record.strands(strands);
    fitted = fit_boundaries(strands, config_);  // III, line or cubic B-spline
  }
  record.fitted(fitted);
  return scene_of(scan, frame, std::move(fitted));
}

}  // namespace verge::detect
