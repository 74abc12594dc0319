// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "verge/core/error.hpp"
#include "verge/core/log.hpp"
#include "verge/io/source.hpp"

namespace verge::io {

/// How to write a recording.
struct SinkOptions {
  std::optional<Format> format{};      ///< None: by the name's suffix.
  std::optional<std::string> model{};  ///< Whose messages a capture or stream holds; none: the scans' own.
  std::optional<std::filesystem::path> calibration{};  ///< Of the sensor; none: the model's own angles.
  bool position_packets = false;  ///< Captures also hold a locked receiver's position packets.
  Log log{};                      ///< What is lost, one line.
};

/// Where scans go: a file each, or all in one recording.
class Sink {
 public:
  Sink() = default;
  Sink(const Sink&) = delete;
  Sink& operator=(const Sink&) = delete;
  virtual ~Sink() = default;

  /// The next scan. Fails with kCannotWrite, and with kUsage for a second scan where the file holds but one.
  [[nodiscard]] virtual Expected<void> write(const Scan& scan) = 0;

  /// Makes what was written appear: a file is whole then, or not there. Call once, at the end.
  [[nodiscard]] virtual Expected<void> finish() = 0;
};

/// A sink for that path. An .mcap, .pcap (pcap_sink.hpp), .idc or .alasca (ibeo_sink.hpp) is one recording of
/// all scans. A format of one scan a file, and a path without its suffix: a folder, made where it is not
/// there and empty where it is, with a file FRAME.SUFFIX for each scan; KITTI's is
/// FOLDER/velodyne/NUMBER.bin, with FOLDER/times.txt beside where every scan has a time (read back to the
/// nanosecond), and poses.txt with calib.txt where every scan has a pose. Points and what the format holds of
/// them come back bit for bit (see the format's write function). Fails with kUsage (no format for that name,
/// or one that is only read) and kCannotWrite (also for a folder that holds files already: no scan of
/// another drive may stand among them).
[[nodiscard]] Expected<std::unique_ptr<Sink>> create(const std::filesystem::path& path,
                                                     const SinkOptions& options = {});

/// Indices of the scan's points in the order in which they stand in a file of that format: what stands beside
/// the file point by point goes by it. Captures and streams hold them in the order of their times.
[[nodiscard]] std::vector<std::uint32_t> written_order(Format format, const Scan& scan);

}  // namespace verge::io
