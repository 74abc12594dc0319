// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>

#include "verge/core/pose.hpp"
#include "verge/scan/scan.hpp"
#include "verge/sensor/beam_model.hpp"
#include "verge/sim/caster.hpp"

namespace verge::sim {

/// How a real sensor departs from a perfect one.
struct NoiseConfig {
  std::uint64_t seed = 1;
  double range_sigma_m = 0.02;        ///< Deviation of the Gaussian noise of each range.
  double dropout_at_range_max = 0.3;  ///< Share of returns lost at the sensor's greatest range, 0..1; it
                                      ///< grows with the square of the range.
};

/// T_world_sensor at so many ns after the start of the drive. Must be callable from several threads at once.
using Trajectory = std::function<Pose(std::int64_t time_ns)>;

/// The label of a point: the Surface in the lower 16 bits, the object (1, 2, ...; 0 = none) in the upper
/// ones, as SemanticKITTI puts class and instance.
[[nodiscard]] std::uint32_t label_of(Surface surface, std::uint32_t object);

/// Revolution `index` (0, 1, ...) of a sensor that turns all the time: the firings that start in
/// [index, index + 1) revolutions after the start of the drive, each shot from the sensor's own pose at its
/// time. A revolution begins at the rear (azimuth pi). Shots without a return, lost ones, and ranges outside
/// the sensor's reach are left out.
///
/// The scan: points in the sensor frame at their own time, in the order of firing as `input_index`;
/// time_offset_ns after stamp_ns, which counts from the start of the drive and is the time of the first
/// firing; motion from the trajectory; `label` the label_of() what was hit; intensity 0..100 as Velodyne
/// scales diffuse reflectors. Ranges are rounded to the sensor's resolution. The same arguments give the same
/// bytes at any number of threads. Throws std::invalid_argument where the model has no lasers, a rate, period
/// or range that is not positive, or the noise is negative or not finite.
[[nodiscard]] Scan simulate_revolution(const Caster& world, const sensor::BeamModel& model,
                                       const Trajectory& T_world_sensor_at, std::uint64_t index,
                                       const NoiseConfig& noise);

}  // namespace verge::sim
