// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "verge/core/error.hpp"
#include "verge/model/scene.hpp"
#include "verge/scan/mount.hpp"
#include "verge/scan/scan.hpp"

namespace verge::pipeline {

/// How long each stage had one scan, seconds. For people only: wall-clock times never enter results.
struct StageTimes {
  double read_s = 0.0;
  double mount_s = 0.0;  ///< Deskewing and mount.
  double detect_s = 0.0;
  double write_s = 0.0;  ///< Records and pictures.
};

/// What happened to the points of all scans: received = used + not_finite + no_return.
struct PointCounts {
  std::uint64_t received = 0;
  std::uint64_t used = 0;
  std::uint64_t not_finite = 0;  ///< Dropped by the reader.
  std::uint64_t no_return = 0;   ///< Range 0.
};

/// How much went through. Depends on the input and the configuration alone.
struct Counts {
  std::size_t scans = 0;    ///< Used ones; received = scans + damaged.
  std::size_t damaged = 0;  ///< Could not be read.
  std::size_t boundaries = 0;
  PointCounts points;
};

/// Adds a scan that was used, and what was found on it.
void add(Counts& counts, const Scan& scan, const Scene& scene);

/// What a run did.
struct Summary {
  Counts counts;
  bool interrupted = false;          ///< Stopped before the end of the recording.
  std::optional<Error> first_error;  ///< Of a damaged scan.
  std::vector<Mount> mounts;         ///< One a scan used, in order.
  std::vector<StageTimes> times;     ///< One a scan used, in order.
};

/// The value that a share `p` in (0, 1] of the values does not exceed (nearest rank). None where there are no
/// values. NaNs must not be among them.
[[nodiscard]] std::optional<double> percentile(std::vector<double> values, double p);

/// One field of each element, for percentile(): column(summary.times, &StageTimes::read_s).
template <class Row>
[[nodiscard]] std::vector<double> column(std::span<const Row> rows, double Row::*field) {
  std::vector<double> values;
  values.reserve(rows.size());
  for (const Row& row : rows) values.push_back(row.*field);
  return values;
}

}  // namespace verge::pipeline
