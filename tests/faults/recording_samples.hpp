// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "verge/io/input.hpp"
#include "verge/io/recording.hpp"

namespace verge::faults {

/// A small valid recording of three scans.
struct RecordingSample {
  std::string name;
  std::string bytes;
  Expected<std::unique_ptr<io::Recording>> (*open)(io::Input, const io::RecordingOptions&) = nullptr;
  /// Where its scans end, in a stream of messages: what is cut there loses the scans behind. Empty: the
  /// format is no stream.
  std::vector<std::size_t> scan_ends{};
};

/// One of each format that holds many scans, but captures.
[[nodiscard]] std::vector<RecordingSample> recording_samples();

}  // namespace verge::faults
