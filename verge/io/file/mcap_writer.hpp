// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>

#include "verge/core/error.hpp"
#include "verge/io/file/packing.hpp"
#include "verge/scan/scan.hpp"

namespace verge::io {

struct McapWriterOptions {
  std::string topic = "/points";
  Packing packing = Packing::kZstd;       ///< kNone, kLz4 or kZstd.
  std::uint64_t chunk_bytes = 4U << 20U;  ///< A chunk is closed when its messages reach this.
};

/// Scans as an MCAP file that ROS 2 plays and Foxglove shows: sensor_msgs/msg/PointCloud2 in CDR, and the
/// poses of scans that have one as tf2_msgs/msg/TFMessage on /tf, from frame "world" to the scan's own. With
/// chunks, indexes, summary and checksums. The file appears whole or not at all; the same scans give the same
/// bytes.
class McapWriter {
 public:
  /// Fails with kCannotWrite.
  [[nodiscard]] static Expected<McapWriter> create(const std::filesystem::path& path,
                                                   const McapWriterOptions& options = {});
  McapWriter(McapWriter&&) noexcept;
  McapWriter& operator=(McapWriter&&) noexcept;
  McapWriter(const McapWriter&) = delete;
  McapWriter& operator=(const McapWriter&) = delete;
  ~McapWriter();

  /// The next scan, with all columns of its points. One without a stamp has the stamp 0 in its header, which
  /// is none. Fails with kCannotWrite; also where the stamp is beyond what ROS can say (32-bit seconds), or a
  /// ring beyond 65535.
  [[nodiscard]] Expected<void> add(const Scan& scan);

  /// Summary and end of the file, which then appears. Call once.
  [[nodiscard]] Expected<void> finish();

 private:
  struct State;
  explicit McapWriter(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace verge::io
