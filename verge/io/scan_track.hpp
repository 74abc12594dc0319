// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "verge/core/pose.hpp"
#include "verge/scan/scan.hpp"

namespace verge::io {

/// When and where scans were taken, as data sets store it beside them: a row a scan.
struct ScanTrack {
  std::vector<std::int64_t> stamps_ns;  ///< Empty: not known.
  std::vector<Pose> T_world_sensor;     ///< Empty: not known.

  /// Gives the scan what row `row` says: stamp, pose, and the motion to the next row's pose (at the last row:
  /// on from the one before), over the time between the two or 0.1 s where times are not known.
  void attach(Scan& scan, std::size_t row) const;
};

}  // namespace verge::io
