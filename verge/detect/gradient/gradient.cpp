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
#include "verge/detect/scan_scene.hpp"

namespace verge::detect {
namespace {

using namespace gradient;  // NOLINT(google-build-using-namespace): the method's own steps, all of them

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
  Scene scene = scene_about(scan);
  for (Fitted& f : fitted) add_boundary(scene, std::move(f.boundary), frame);
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
    record.scan_lines(lines);
    fitted = fit_sides_as_printed(lines, config_);  // III
  } else {
    const auto lines = scan_lines(low, Obstacles(low, config_), config_);  // II-1 (2), (3)
    record.scan_lines(lines);
    record.candidates(lines);
    const auto strands = denoise(lines, mount.height_m, config_);  // II-1 (3)
    record.strands(strands);
    fitted = fit_boundaries(strands, config_);  // III, line or cubic B-spline
  }
  record.fitted(fitted);
  return scene_of(scan, frame, std::move(fitted));
}

}  // namespace verge::detect
