// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <vector>

#include "verge/scan/organise.hpp"

// Clouds for the tests and benchmarks of the scan room. Readers here are minimal on purpose: the room stands
// below io, and files that they do not understand give an empty cloud.

namespace verge::testing {

/// A spinning sensor over flat ground between two walls: what organise() has to put in order.
struct SensorPlan {
  std::vector<double> elevation_rad;  ///< Of each ring, from the lowest up.
  std::size_t columns = 1800;         ///< Firings a turn.
  double height_m = 1.8;
  double noise_m = 0.01;
  bool clockwise = false;
};

/// Evenly spaced rings.
[[nodiscard]] SensorPlan plan(std::size_t rings, double lowest_deg, double highest_deg, std::size_t columns);

/// The cloud ring by ring from the top, each ring from azimuth 0 on (as KITTI stores it), with ring,
/// intensity and time. The same seed gives the same bytes.
[[nodiscard]] Cloud simulate(const SensorPlan& plan, unsigned seed = 1);

/// The point order[i] of the cloud in place i, in every column.
[[nodiscard]] Cloud reordered(const Cloud& cloud, const std::vector<std::size_t>& order);
/// Column by column: all rings of a firing before the next firing, as packets arrive.
[[nodiscard]] Cloud column_major(const Cloud& cloud);
/// Some order that has nothing to do with the sensor; the same for the same seed.
[[nodiscard]] Cloud shuffled(const Cloud& cloud, unsigned seed);
/// Turned about z.
[[nodiscard]] Cloud turned(const Cloud& cloud, double angle_rad);

/// The folder VERGE_DATA, if set.
[[nodiscard]] std::optional<std::filesystem::path> data_folder();
/// Files below `folder` that end in `suffix`, sorted.
[[nodiscard]] std::vector<std::filesystem::path> files_in(const std::filesystem::path& folder,
                                                          const std::string& suffix);
/// Four floats a point.
[[nodiscard]] Cloud read_kitti(const std::filesystem::path& file);
/// Five floats a point, turned to x forward, with ring.
[[nodiscard]] Cloud read_nuscenes(const std::filesystem::path& file);
/// Binary PCD of `step` bytes a point with x, y, z as its first three floats and, where `ring_at` says, a
/// 16-bit ring.
[[nodiscard]] Cloud read_pcd(const std::filesystem::path& file, std::size_t step,
                             std::optional<std::size_t> ring_at);

}  // namespace verge::testing
