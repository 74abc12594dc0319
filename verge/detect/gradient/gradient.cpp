// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/detect/gradient/gradient.hpp"

#include <array>
#include <optional>
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
#include "verge/detect/gradient/road_axis.hpp"

namespace verge::detect {
namespace {

using namespace gradient;  // NOLINT(google-build-using-namespace): the method's own steps, all of them

/// A scan line in one region, and what II-1 (2) and (3) make of it.
struct ScanLine {
  Layer layer;
  GradientPoints points;
  LayerClusters clusters;
  std::optional<Candidate> candidate;
};

/// II-1 (2) and (3), K and clusters, of one scan line, as printed.
ScanLine scan_line_as_printed(Layer layer, const GradientConfig& config) {
  auto points = gradient_points_as_printed(layer, config);
  auto clusters = cluster_layer(layer, points, config);
  return {std::move(layer), std::move(points), std::move(clusters), std::nullopt};
}

/// The same, fixed reading, and where it meets the boundary.
ScanLine scan_line(Layer layer, const Obstacles& obstacles, const GradientConfig& config) {
  auto points = gradient_points(layer, config);
  auto clusters = cluster_layer(layer, points, config);
  auto candidate = first_outward(layer, points, clusters, obstacles, config);
  return {std::move(layer), std::move(points), std::move(clusters), candidate};
}

/// Paper reading: regions a to d.
std::vector<ScanLine> scan_lines_as_printed(const std::vector<LowRing>& low, const GradientConfig& config) {
  std::vector<ScanLine> lines;
  for (Layer& layer : split_quadrants(low)) lines.push_back(scan_line_as_printed(std::move(layer), config));
  return lines;
}

/// Fixed reading: regions a to d along the road, from the vehicle outward.
std::vector<ScanLine> scan_lines(const std::vector<LowRing>& low, const Obstacles& obstacles,
                                 const GradientConfig& config) {
  std::vector<ScanLine> lines;
  for (const bool front : {true, false}) {
    RoadAxis axis(front);
    for (const LowRing& ring : low) {
      const std::vector<Vec3> half = half_of(ring, front);
      axis.advance(half);
      const Vec2 direction = axis.direction();
      std::array<std::optional<Vec2>, 2> feet;
      for (const bool right : {false, true}) {
        lines.push_back(scan_line(part_of(ring, half, front, right, direction), obstacles, config));
        if (const auto& met = lines.back().candidate) feet[right ? 1 : 0] = met->foot.xy();
      }
      axis.follow(feet[0], feet[1]);
    }
  }
  return lines;
}

/// II-1 (3), fixed reading: boundary points of adjacent layers linked, front and rear joined, noise dropped.
std::vector<Strand> denoise(const std::vector<ScanLine>& lines, double height_m, const GradientConfig& config,
                            Recorder& record) {
  std::vector<Chain> chains;
  for (const Quadrant region : kQuadrants) {
    std::vector<Candidate> candidates;
    for (const ScanLine& line : lines) {
      if (line.layer.region == region && line.candidate) candidates.push_back(*line.candidate);
    }
    record.candidates(region, candidates);
    for (Chain& chain : link_layers(region, candidates, height_m, config)) chains.push_back(std::move(chain));
  }
  std::vector<Strand> strands = join_front_and_rear(chains, false, height_m, config);
  for (Strand& right : join_front_and_rear(chains, true, height_m, config))
    strands.push_back(std::move(right));
  return strands;
}

/// III, paper reading: all points of a side's clusters make one boundary.
std::vector<Fitted> fit_sides_as_printed(const std::vector<ScanLine>& lines, const GradientConfig& config) {
  std::vector<Fitted> sides;
  for (const bool right : {false, true}) {
    std::vector<Vec3> side;
    for (const ScanLine& line : lines) {
      if (is_right(line.layer.region) != right) continue;
      for (const std::vector<std::size_t>& cluster : line.clusters.clusters) {
        for (const std::size_t k : cluster) side.push_back(line.layer.points[line.points.index[k]]);
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

  const auto low = height_gate(scan, frame, config_);  // II-1 (1)
  record.low(low);
  std::vector<Fitted> fitted;
  if (config_.reading == Reading::kPaper) {
    const auto lines = scan_lines_as_printed(low, config_);  // II-1 (2), (3)
    for (const ScanLine& line : lines) record.scan_line(line.layer, line.points, line.clusters);
    fitted = fit_sides_as_printed(lines, config_);  // III
  } else {
    const auto lines = scan_lines(low, Obstacles(low, config_), config_);  // II-1 (2), (3)
    for (const ScanLine& line : lines) record.scan_line(line.layer, line.points, line.clusters);
    const auto strands = denoise(lines, mount.height_m, config_, record);  // II-1 (3)
    record.strands(strands);
    fitted = fit_boundaries(strands, config_);  // III, line or cubic B-spline
  }
  record.fitted(fitted);
  return scene_of(scan, frame, std::move(fitted));
}

}  // namespace verge::detect
