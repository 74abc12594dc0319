// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/detect/lda/windows.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "verge/cluster/runs.hpp"

namespace verge::detect::lda {
namespace {

constexpr double kLateralNoise = 0.02;  // metres
constexpr double kLeastHeight = 0.1;    // metres: of a sensor

/// The least gap that parts two pieces of the scan line, after each of its returns but the last.
std::vector<double> gap_thresholds(const QuadrantRing& ring, const LdaConfig& config) {
  std::vector<double> m;
  for (std::size_t i = 1; i < ring.points.size(); ++i) {
    m.push_back(std::max(config.gap_min_m, config.gap_factor * norm(ring.points[i].xy()) * ring.spacing_rad));
  }
  return m;
}

std::vector<Vec2> in_plane(const QuadrantRing& ring) {
  std::vector<Vec2> plane;
  for (const Vec3 p : ring.points) plane.push_back(p.xy());
  return plane;
}

}  // namespace

Features features_of(std::span<const Vec3> window, double height_m) {
  assert(window.size() >= 3);
  const auto n = static_cast<double>(window.size());
  double low = window.front().z;
  double high = low;
  double y = 0.0;
  double z = 0.0;
  for (const Vec3 p : window) {
    low = std::min(low, p.z);
    high = std::max(high, p.z);
    y += p.y / n;
    z += p.z / n;
  }
  double yy = 0.0;
  double yz = 0.0;
  double zz = 0.0;
  for (const Vec3 p : window) {
    yy += (p.y - y) * (p.y - y) / n;
    yz += (p.y - y) * (p.z - z) / n;
    zz += (p.z - z) * (p.z - z) / n;
  }
  // The second differences of a sequence add up to the difference of its last and its first step.
  const std::size_t last = window.size() - 1;
  const double steps = (window[last].z - window[last - 1].z) - (window[1].z - window[0].z);
  return {high - low, std::sqrt(zz), std::abs(yz / (yy + kLateralNoise * kLateralNoise)),
          z / std::max(height_m, kLeastHeight), std::abs(steps) / (n - 2.0)};
}

std::vector<Window> windows_of(const QuadrantRing& ring, double height_m, const LdaConfig& config) {
  const auto size = static_cast<std::size_t>(config.window);
  std::vector<Window> windows;
  for (const cluster::PointRun& piece : cluster::gap_separated_runs(
           ring.points.size(), cluster::adjacent_distances(in_plane(ring)), gap_thresholds(ring, config))) {
    for (std::size_t i = piece.begin; i + size <= piece.end; ++i) {
      windows.push_back({i + size / 2, features_of(std::span(ring.points).subspan(i, size), height_m)});
    }
  }
  return windows;
}

double discriminant(const Features& features, const LdaConfig& config) {
  double sum = -config.threshold;
  for (std::size_t k = 0; k < kFeatures; ++k) sum += config.*kFeatureNames[k].value * features[k];
  return sum;
}

std::vector<LowRing> low_rings(const Scan& scan, const LevelFrame& frame, const LdaConfig& config) {
  return height_gate(scan, frame,
                     {config.height_max_m, config.lateral_max_m, config.forward_max_m, config.range_min_m});
}

}  // namespace verge::detect::lda
