// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "verge/core/error.hpp"
#include "verge/core/pose.hpp"
#include "verge/scan/scan.hpp"

namespace verge::app {

/// Where the sensor was at each scan, for recordings that do not say it: CSV with a line of names first,
/// among them frame, x_m, y_m, z_m, qw, qx, qy, qz (from the sensor to a world of any origin), and stamp_ns
/// where it is known; as `verge simulate` writes it (poses.csv).
class PoseFile {
 public:
  /// Fails with kCannotOpen, or kUsage and the line and column of a name that is missing, a field that is no
  /// number, a rotation that is none.
  [[nodiscard]] static Expected<PoseFile> read(const std::filesystem::path& file);

  /// Gives the scan the pose of its frame; and, where both that and the next line have a time and the points
  /// have theirs, the motion between, if nothing better is known. A frame that the file lacks stays as it is.
  void give(Scan& scan);

  /// Whether give() found a frame.
  [[nodiscard]] bool was_used() const { return used_; }

 private:
  struct Row {
    std::optional<std::int64_t> stamp_ns;
    Pose T_world_sensor;
  };

  std::vector<Row> rows_;
  std::map<std::string, std::size_t, std::less<>> row_of_;
  bool used_ = false;
};

}  // namespace verge::app
