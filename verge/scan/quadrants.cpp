// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/scan/quadrants.hpp"

#include <algorithm>
#include <cmath>

#include "verge/core/statistics.hpp"

namespace verge {
namespace {

/// Grows with the direction of (x, y) from -pi to pi, without trigonometry.
double pseudo_angle(Vec3 p) {
  const double length = std::abs(p.x) + std::abs(p.y);
  const double sine = length > 0.0 ? p.y / length : 0.0;
  if (p.x >= 0.0) return sine;
  return (p.y >= 0.0 ? 2.0 : -2.0) - sine;
}

/// Of all returns of a ring: the mean of a sample would differ when the scan is mirrored or turned, and what
/// lies at the edge of a threshold with it.
double mean_elevation(const Scan& scan, std::size_t begin, std::size_t end) {
  double sines = 0.0;
  std::size_t n = 0;
  for (std::size_t i = begin; i < end; ++i) {
    if (!(scan.range[i] > 0.0F)) continue;
    sines += static_cast<double>(scan.z[i]) / static_cast<double>(scan.range[i]);
    ++n;
  }
  return n > 0 ? std::asin(std::clamp(sines / static_cast<double>(n), -1.0, 1.0)) : 0.0;
}

/// From at most so many returns spread evenly over the ring.
constexpr std::size_t kSamples = 64;

double median_spacing(const Scan& scan, std::size_t begin, std::size_t end) {
  const std::size_t stride = (end - begin) / kSamples + 1;
  std::vector<double> spacing;
  for (std::size_t i = begin; i + 1 < end; i += stride) {
    spacing.push_back(static_cast<double>(scan.azimuth[i + 1] - scan.azimuth[i]));
  }
  return median(spacing).value_or(0.0);
}

bool is_low(Vec3 p, const LowGate& gate) {
  return p.z < gate.height_max_m && std::abs(p.y) < gate.lateral_max_m &&
         std::abs(p.x) < gate.forward_max_m && norm(p.xy()) > gate.range_min_m;
}

/// Starts the ring at the smallest direction of the level frame: tilt and heading have moved the seam.
void start_at_seam(std::vector<Vec3>& points) {
  const auto first = std::min_element(points.begin(), points.end(),
                                      [](Vec3 a, Vec3 b) { return pseudo_angle(a) < pseudo_angle(b); });
  std::rotate(points.begin(), first, points.end());
}

}  // namespace

std::vector<LowRing> height_gate(const Scan& scan, const LevelFrame& frame, const LowGate& gate) {
  std::vector<LowRing> low;
  for (std::size_t r = 0; r < scan.ring_count(); ++r) {
    const auto [begin, end] = scan.ring(r);
    LowRing ring{r, 0.0, 0.0, {}};
    for (std::size_t i = begin; i < end; ++i) {
      if (!(scan.range[i] > 0.0F)) continue;
      const Vec3 p = frame.to_level(scan.point(i));
      if (is_low(p, gate)) ring.points.push_back(p);
    }
    if (ring.points.empty()) continue;
    ring.elevation_rad = mean_elevation(scan, begin, end);
    ring.spacing_rad = median_spacing(scan, begin, end);
    start_at_seam(ring.points);
    low.push_back(std::move(ring));
  }
  return low;
}

std::vector<QuadrantRing> split_quadrants(const std::vector<LowRing>& low) {
  std::vector<QuadrantRing> layers;
  for (const Quadrant region : kQuadrants) {
    for (const LowRing& ring : low) {
      QuadrantRing layer{ring.ring, region, ring.elevation_rad, ring.spacing_rad, {}};
      std::copy_if(ring.points.begin(), ring.points.end(), std::back_inserter(layer.points),
                   [region](Vec3 p) { return quadrant_of(p) == region; });
      if (outward_sign(region) < 0) std::reverse(layer.points.begin(), layer.points.end());
      if (!layer.points.empty()) layers.push_back(std::move(layer));
    }
  }
  return layers;
}

}  // namespace verge
