// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/detect/gradient/gradient.hpp"

#include <utility>
#include <vector>

#include "verge/core/field_io.hpp"
#include "verge/detect/gradient/boundaries.hpp"
#include "verge/detect/gradient/denoise.hpp"
#include "verge/detect/gradient/obstacles.hpp"
#include "verge/detect/gradient/recorder.hpp"
#include "verge/detect/gradient/scan_lines.hpp"

namespace verge::detect {
namespace {

using namespace gradient;  // NOLINT(google-build-using-namespace): the method's own steps, all of them

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
