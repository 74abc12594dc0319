// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string_view>
#include <vector>

#include "verge/core/vec.hpp"
#include "verge/detect/lda/lda.hpp"
#include "verge/scan/mount.hpp"
#include "verge/scan/quadrants.hpp"
#include "verge/scan/scan.hpp"

namespace verge::detect::lda {

inline constexpr std::size_t kFeatures = 5;
using Features = std::array<double, kFeatures>;

/// What each feature of f (A2.3) is, and the setting that is its weight.
struct FeatureName {
  std::string_view weight;
  double LdaConfig::*value;
  std::string_view meaning;
};
inline constexpr std::array<FeatureName, kFeatures> kFeatureNames{{
    {"weight_step", &LdaConfig::weight_step, "greatest less least height, m"},
    {"weight_deviation", &LdaConfig::weight_deviation, "standard deviation of the heights, m"},
    {"weight_slope", &LdaConfig::weight_slope,
     "size of the least-squares slope of height over lateral place"},
    {"weight_compression", &LdaConfig::weight_compression,
     "(rho_plane - rho) / rho_plane: how much nearer the returns are than the road's plane"},
    {"weight_bend", &LdaConfig::weight_bend, "size of the mean second difference of the heights, m"},
}};

/// The features of a window of at least 3 returns, which follow each other along a scan line, in the level
/// frame. `height_m` is that of the sensor.
///
/// Slope: cov(s, z) / (var(s) + (2 cm)^2) with s = y: on a vertical face s is noise, and without its variance
/// the slope would be anything. Compression, with its sign: the beam of a return at height z over the road
/// meets the plane at rho_plane = rho h / (h - z), so that (rho_plane - rho) / rho_plane = z / h, whatever
/// the mount's tilt; of the mean height. Without the sign, a road that falls away from the plane below the
/// vehicle (its other half, behind the crown) looks like a kerb.
[[nodiscard]] Features features_of(std::span<const Vec3> window, double height_m);

/// The window whose middle is the return of that index.
struct Window {
  std::size_t middle = 0;
  Features features{};
};

/// Every window of a scan line, from the road's axis outward. None spans a gap (gap_min_m, gap_factor).
[[nodiscard]] std::vector<Window> windows_of(const QuadrantRing& ring, double height_m,
                                             const LdaConfig& config);

/// w^T f - c: positive on the side of the edges.
[[nodiscard]] double discriminant(const Features& features, const LdaConfig& config);

/// The returns that are looked at, with the gate of the settings.
[[nodiscard]] std::vector<LowRing> low_rings(const Scan& scan, const LevelFrame& frame,
                                             const LdaConfig& config);

}  // namespace verge::detect::lda
