// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>

#include "verge/core/pose.hpp"
#include "verge/scan/scan.hpp"
#include "verge/sim/caster.hpp"
#include "verge/sim/echoes.hpp"
#include "verge/sim/lidar_model.hpp"
#include "verge/sim/weather.hpp"

namespace verge::sim {

/// T_world_sensor at so many ns after the start of the drive. Must be callable from several threads at once.
using Trajectory = std::function<Pose(std::int64_t time_ns)>;

/// Scan `index` (0, 1, ...) of a sensor that runs all the time, each shot from the sensor's own pose at its
/// time. Shots without a return, lost ones, and ranges outside the sensor's reach are left out.
///
/// The scan: points in the sensor frame at their own time, in the order of the shots as `input_index`, the
/// echoes of one shot nearest first; time_offset_ns after stamp_ns, which counts from the start of the drive
/// and is the time of the first shot; motion from the trajectory; `label` the label_of() what was hit;
/// intensity, echo, pulse width and flags where the sensor says them. Ranges are rounded to the sensor's
/// resolution. The same arguments give the same bytes at any number of threads. Throws std::invalid_argument
/// where a value of the noise or the weather is outside its range.
[[nodiscard]] Scan simulate_scan(const Caster& world, const LidarModel& model,
                                 const Trajectory& T_world_sensor_at, std::uint64_t index,
                                 const NoiseConfig& noise, const Weather& weather = {});

}  // namespace verge::sim
