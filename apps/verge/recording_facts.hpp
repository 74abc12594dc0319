// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "verge/io/recording.hpp"
#include "verge/pipeline/summary.hpp"
#include "verge/scan/scan.hpp"

namespace verge::app {

/// What `verge info` says of a recording; grows by a few numbers a scan.
struct RecordingFacts {
  std::string format;
  std::vector<std::string> first_and_last;  ///< Names of the first and the last scan.
  pipeline::Counts counts;
  std::vector<double> points;       ///< A scan.
  std::vector<double> rings;        ///< A scan.
  std::vector<double> range_min_m;  ///< Of the returns of a scan; scans without returns have none.
  std::vector<double> range_median_m;
  std::vector<double> range_max_m;
  std::vector<double> elevation_min_rad;
  std::vector<double> elevation_max_rad;
  std::vector<double> intensity_min;
  std::vector<double> intensity_max;
  std::set<std::string> fields;          ///< What the scans carry beside x, y, z.
  std::optional<std::int64_t> first_ns;  ///< Time of the first scan that has one.
  std::optional<std::int64_t> last_ns;
  std::vector<Mount> mounts;          ///< Where a road surface was found.
  std::vector<io::Counter> counters;  ///< Of the recording's packets, messages and bytes.
  std::vector<std::string> notes;     ///< What the reader had to say.
};

/// Adds what a scan shows.
void add(RecordingFacts& facts, const Scan& scan);

/// As a table for people.
[[nodiscard]] std::string to_text(const RecordingFacts& facts);
/// As one JSON object for programs.
[[nodiscard]] std::string to_json(const RecordingFacts& facts);

}  // namespace verge::app
