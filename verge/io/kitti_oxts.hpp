// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "verge/core/log.hpp"
#include "verge/core/pose.hpp"
#include "verge/io/input.hpp"

namespace verge::io {

/// What the GPS/IMU unit of KITTI's raw drives says at one time: the first six numbers of a row in oxts/data.
struct OxtsFix {
  double latitude_deg = 0.0;
  double longitude_deg = 0.0;
  double altitude_m = 0.0;
  double roll_rad = 0.0;   ///< Positive = left side up.
  double pitch_rad = 0.0;  ///< Positive = nose down.
  double yaw_rad = 0.0;    ///< 0 = east, counter-clockwise.
};

/// A row of oxts/data: at least six numbers. None: it is none.
[[nodiscard]] std::optional<OxtsFix> parse_oxts(std::string_view row);

/// The unit's pose in metres east, north and up, by the Mercator projection whose scale is right at
/// `latitude_deg` (the drive's first), as KITTI's development kit projects. Source: Geiger et al., "Vision
/// meets Robotics: The KITTI Dataset", IJRR 2013, and the kit's readme.
[[nodiscard]] Pose pose_of(const OxtsFix& fix, double latitude_deg);

/// Poses of the lidar at the given times, in the lidar's frame at the first of them: from DRIVE/oxts
/// (data/*.txt and timestamps.txt) and DRIVE/../calib_imu_to_velo.txt, where `scans` is
/// DRIVE/velodyne_points/data; between two fixes the pose is interpolated, outside them it is the first's or
/// the last's. Empty where there are none; says in the log what was used, and what was not and why.
[[nodiscard]] std::vector<Pose> find_oxts_poses(const std::filesystem::path& scans,
                                                std::span<const std::int64_t> stamps_ns,
                                                const InputLimits& limits, const Log& log);

}  // namespace verge::io
