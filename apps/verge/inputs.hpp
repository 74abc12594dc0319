// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "apps/verge/pose_file.hpp"
#include "verge/core/error.hpp"
#include "verge/core/log.hpp"
#include "verge/io/recording.hpp"
#include "verge/io/source.hpp"

namespace verge::app {

/// Which scans of a recording: [begin, end), counted from 0.
struct FrameRange {
  std::size_t begin = 0;
  std::optional<std::size_t> end;  ///< None: to the last.
};

/// "a:b", either side may be missing. Fails with kUsage.
[[nodiscard]] Expected<FrameRange> parse_frames(std::string_view text);

/// What to read, as the command line says it.
struct InputRequest {
  std::vector<std::string> paths;  ///< Files and folders; "-" is standard input.
  std::optional<std::string> format;
  std::optional<std::string> topic;
  std::optional<std::string> sensor_ip;
  std::optional<std::string> model;
  std::optional<std::string> calibration;
  std::optional<std::string> poses;  ///< As PoseFile reads it.
  std::string frames = ":";
  std::uint64_t max_mem_mib = 1024;
};

/// Several recordings, read one after the other as if they were one. A file is opened when its turn comes:
/// a shell may name more of them than a process may hold open.
class Inputs {
 public:
  /// Lists folders and looks whether every file is there, so that a misspelled path ends the run before any
  /// work. Fails with the first input's error: kUsage, kCannotOpen, or kUnusable for a folder without scans.
  [[nodiscard]] static Expected<Inputs> open(const InputRequest& request, const Log& log);

  /// As io::Source::next(), with the poses asked for; a file that cannot be opened after all counts as a
  /// damaged scan. Where none of the scans had a pose in the file for it, the log hears it at the end.
  [[nodiscard]] Expected<std::optional<Scan>> next();

  /// Scans to come, damaged ones included, before the first next(); none where a recording does not say how
  /// many it holds.
  [[nodiscard]] std::optional<std::size_t> total() const;
  /// What the recordings' packets, messages and bytes came to so far, names added up over all of them.
  [[nodiscard]] std::vector<io::Counter> counters() const;
  /// Of the input that next() read last.
  [[nodiscard]] std::optional<io::Format> format() const { return format_; }

 private:
  /// A folder is listed when it is made, a file opened when it is read.
  struct Part {
    std::string path;
    std::optional<std::size_t> count = 1;  ///< Scans in it; none: not known before it was read.
    std::size_t begin = 0;
    std::optional<std::size_t> end;  ///< None: to the last.
    std::unique_ptr<io::Source> source;
  };

  Inputs() = default;
  [[nodiscard]] static Expected<Part> look_at(const std::string& path, const io::OpenOptions& options);
  [[nodiscard]] Expected<void> keep(const FrameRange& range);
  void done_with_part();
  [[nodiscard]] Expected<void> ready(Part& part);

  io::OpenOptions options_;
  std::deque<Part> parts_;
  std::vector<io::Counter> counters_;  // of the parts that are done
  std::optional<PoseFile> poses_;
  std::optional<io::Format> format_;
};

}  // namespace verge::app
