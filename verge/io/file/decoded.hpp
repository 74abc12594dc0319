// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "verge/core/pose.hpp"
#include "verge/scan/organise.hpp"
#include "verge/scan/scan.hpp"

namespace verge::io {

/// What a format's reader makes of a file, or of one scan of it: the points in the file's order, x forward, y
/// left, z up.
struct Decoded {
  Cloud cloud;  ///< time_s runs from the first point where the file has absolute times.
  std::optional<std::int64_t> stamp_ns;  ///< Time of the first point, where the file says so.
  std::vector<std::string> notes;        ///< What was decided or left out, one line each.
  std::optional<Motion> motion;          ///< Of the sensor over this scan, where the file says so.
  std::optional<Pose> T_world_sensor;    ///< At stamp_ns.
  std::string sensor;                    ///< Model, as Scan::sensor; empty where it is not known.
  std::string frame_id;                  ///< Name of the points' frame; empty where the file has none.
};

}  // namespace verge::io
