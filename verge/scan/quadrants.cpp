// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/scan/quadrants.hpp"

#include <algorithm>
#include <cmath>

#include "verge/core/statistics.hpp"

namespace verge {
namespace {

/// The mean elevation of a ring's returns, each weighing as much as its range. Of all of them: that of a
/// sample would differ when the scan is mirrored or turned, and what lies at the edge of a threshold with it.
struct MeanElevation {
  double height = 0.0;
  double range = 0.0;

  void add(float z, float distance) {
    height += static_cast<double>(z);
    range += static_cast<double>(distance);
  }
  [[nodiscard]] double value_rad() const { return std::asin(std::clamp(height / range, -1.0, 1.0)); }
};

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
         std::abs(p.x) < gate.forward_max_m && dot(p.xy(), p.xy()) > gate.range_min_m * gate.range_min_m;
}

/// Whether the direction jumps from pi to -pi between two neighbours, behind: tilt and heading have moved
/// that seam, and a ring is to start there.
bool is_seam(Vec3 a, Vec3 b) { return b.y < 0.0 && a.y >= 0.0 && (a.x < 0.0 || b.x < 0.0); }

}  // namespace

std::vector<LowRing> height_gate(const Scan& scan, const LevelFrame& frame, const LowGate& gate) {
  std::vector<LowRing> low;
  for (std::size_t r = 0; r < scan.ring_count(); ++r) {
    const auto [begin, end] = scan.ring(r);
    LowRing ring{r, 0.0, 0.0, {}};
    ring.points.reserve(end - begin);
    MeanElevation elevation;
    std::size_t seam = 0;
    for (std::size_t i = begin; i < end; ++i) {
      if (!(scan.range[i] > 0.0F)) continue;
      elevation.add(scan.z[i], scan.range[i]);
      const Vec3 p = frame.to_level(scan.point(i));
      if (!is_low(p, gate)) continue;
      if (seam == 0 && !ring.points.empty() && is_seam(ring.points.back(), p)) seam = ring.points.size();
      ring.points.push_back(p);
    }
    if (ring.points.empty()) continue;
    ring.elevation_rad = elevation.value_rad();
    ring.spacing_rad = median_spacing(scan, begin, end);
    std::rotate(ring.points.begin(), ring.points.begin() + static_cast<std::ptrdiff_t>(seam),
                ring.points.end());
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
