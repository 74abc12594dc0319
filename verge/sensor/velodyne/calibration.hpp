// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "verge/core/bytes.hpp"
#include "verge/core/error.hpp"
#include "verge/sensor/velodyne/facts.hpp"

namespace verge::sensor::velodyne {

/// The calibration of one sensor from the YAML that the public ROS driver reads: `lasers:`, a list of maps
/// with `laser_id` and, each 0 where it is missing, `vert_correction`, `rot_correction` (radians),
/// `dist_correction`, `vert_offset_correction`, `horiz_offset_correction`; `dist_correction_x` and `_y` count
/// where `two_pt_correction_available` is true. Other keys are skipped. Block and flow style, comments; no
/// anchors.
///
/// `name` stands in errors, with line and column. Fails with kUnusable: longer than 1 MiB, not a key and a
/// value, no lasers, an id that is missing, repeated or not 0 .. number of lasers - 1, a number that is none
/// or not finite, two lasers with the same elevation (their rings would be a guess), and with kUsage where it
/// does not have `lasers` lasers.
[[nodiscard]] Expected<Calibration> read_calibration(Bytes bytes, const std::string& name,
                                                     std::size_t lasers);

}  // namespace verge::sensor::velodyne
