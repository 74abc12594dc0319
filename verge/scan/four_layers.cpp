// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/scan/four_layers.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <numeric>
#include <optional>
#include <span>

#include "verge/core/angle.hpp"

namespace verge {
namespace {

constexpr std::size_t kLayers = 4;

struct RingAhead {
  std::size_t ring = 0;
  double tangent = 0.0;  ///< Of the angle from the vertical at which it meets the road straight ahead.
};

/// The ring's first echo nearest to straight ahead (of two, the left one); none where it looks elsewhere.
std::optional<std::size_t> nearest_ahead(const Scan& scan, std::size_t ring, double forward_rad,
                                         double side_rad) {
  std::optional<std::size_t> nearest;
  double best_rad = side_rad;
  for (const std::size_t i : from_left(scan, ring, forward_rad)) {
    const double off_rad = std::fabs(wrap_pi(double{scan.azimuth[i]} - forward_rad));
    if (!is_first_echo(scan, i) || off_rad > best_rad || (nearest && off_rad == best_rad)) continue;
    nearest = i;
    best_rad = off_rad;
  }
  return nearest;
}

/// Rings that meet the road straight ahead, and not what stands on it or the sky.
std::vector<RingAhead> rings_on_road(const Scan& scan, const LevelFrame& frame, const Mount& mount,
                                     double side_rad) {
  constexpr double kRoad_m = 0.3;
  std::vector<RingAhead> rings;
  for (std::size_t ring = 0; ring < scan.ring_count(); ++ring) {
    const auto middle = nearest_ahead(scan, ring, mount.forward_rad, side_rad);
    if (!middle) continue;
    const Vec3 p = frame.to_level(scan.point(*middle));
    if (p.x > 0.0 && std::fabs(p.z) <= kRoad_m) rings.push_back({ring, p.x / mount.height_m});
  }
  return rings;
}

/// Of more than four (nearest first), those nearest to where the layers would be, in order.
std::vector<RingAhead> stand_ins(const std::vector<RingAhead>& all, const FourLayers& layers) {
  std::vector<RingAhead> chosen;
  std::size_t next = 0;
  for (std::size_t i = 0; i < kLayers; ++i) {
    const double part = static_cast<double>(i) / (kLayers - 1);
    const double tangent = std::tan(layers.nearest_rad + part * layers.span_rad);
    const std::size_t last = all.size() - (kLayers - 1 - i);  // so that each of the others gets one
    std::size_t best = next;
    for (std::size_t k = next; k < last; ++k) {
      if (std::fabs(all[k].tangent - tangent) < std::fabs(all[best].tangent - tangent)) best = k;
    }
    chosen.push_back(all[best]);
    next = best + 1;
  }
  return chosen;
}

}  // namespace

std::vector<std::size_t> from_left(const Scan& scan, std::size_t ring, double forward_rad) {
  const auto [begin, end] = scan.ring(ring);
  const double behind_rad =
      forward_rad > 0.0 ? forward_rad - std::numbers::pi : forward_rad + std::numbers::pi;
  const auto azimuths = std::span(scan.azimuth).subspan(begin, end - begin);
  const auto split =
      begin + static_cast<std::size_t>(std::upper_bound(azimuths.begin(), azimuths.end(), behind_rad) -
                                       azimuths.begin());
  std::vector<std::size_t> order;
  order.reserve(end - begin);
  for (std::size_t i = split; i-- > begin;) order.push_back(i);
  for (std::size_t i = end; i-- > split;) order.push_back(i);
  return order;
}

std::vector<std::size_t> rings_of_four_layers(const Scan& scan, const LevelFrame& frame, const Mount& mount,
                                              const FourLayers& layers) {
  std::vector<std::size_t> rings;
  if (scan.ring_count() <= kLayers) {
    rings.resize(scan.ring_count());
    std::iota(rings.begin(), rings.end(), std::size_t{0});
    return rings;
  }
  if (!(mount.height_m > 0.0)) return rings;
  std::vector<RingAhead> ahead = rings_on_road(scan, frame, mount, layers.side_rad);
  if (ahead.size() > kLayers) ahead = stand_ins(ahead, layers);
  std::ranges::transform(ahead, std::back_inserter(rings), &RingAhead::ring);
  return rings;
}

}  // namespace verge
