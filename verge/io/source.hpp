// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "verge/core/bytes.hpp"
#include "verge/core/error.hpp"
#include "verge/core/fields.hpp"
#include "verge/core/log.hpp"
#include "verge/io/recording.hpp"
#include "verge/scan/scan.hpp"

namespace verge::io {

/// File formats that hold scans; formats.hpp has their facts.
enum class Format : std::uint8_t {
  kKitti,
  kNuscenes,
  kPcd,
  kPly,
  kCsv,
  kLas,
  kIbeo,
  kAlasca,
  kPcap,
  kBag,
  kDb3,
  kMcap
};
}  // namespace verge::io

namespace verge {
template <>
inline constexpr std::array enum_names<io::Format> = std::to_array<std::string_view>(
    {"kitti", "nuscenes", "pcd", "ply", "csv", "las", "ibeo", "alasca", "pcap", "bag", "db3", "mcap"});
}  // namespace verge

namespace verge::io {

/// How to open a recording.
struct OpenOptions {
  std::optional<Format> format{};  ///< None: guessed from the content, then the name.
  std::uint64_t memory_max_bytes =
      1ULL << 30;                ///< Ceiling for one scan (reliability B1); beyond it: ErrorCode::kLimit.
  std::size_t frames_begin = 0;  ///< First scan to hand out, counted from 0.
  std::optional<std::size_t> frames_end{};  ///< Past the last; none: all.
  int timeout_ms = 5000;                    ///< For a FIFO that nobody writes.
  std::optional<std::string> topic{};       ///< These four: see RecordingOptions.
  std::optional<std::string> sensor_ip{};
  std::optional<std::string> model{};
  std::optional<std::filesystem::path> calibration{};
  Log log{};  ///< Notes and warnings, one line each.
};

/// What the recording holds, as far as it is known without reading it through.
struct SourceInfo {
  Format format = Format::kKitti;
  std::vector<std::filesystem::path> files;  ///< In natural order; the frames asked for.
  std::optional<std::size_t> scans{};  ///< How many next() will say something of; none: known at the end.
};

/// Scans of a recording, one by one. Memory does not grow with the length of the recording.
class Source {
 public:
  Source() = default;
  Source(const Source&) = delete;
  Source& operator=(const Source&) = delete;
  virtual ~Source() = default;

  /// The next scan; none at the end; an Error for a scan that cannot be used. After an Error the next call
  /// goes on with the scan after it, so that one damaged file does not end a recording.
  [[nodiscard]] virtual Expected<std::optional<Scan>> next() = 0;

  [[nodiscard]] virtual const SourceInfo& info() const = 0;

  /// What the recording's own pieces (packets, messages, bytes) came to so far; empty where a file is a scan.
  [[nodiscard]] virtual std::vector<Counter> counters() const { return {}; }
};

/// Opens one file or a folder of files of one format (natural sort). Beside the files it finds KITTI's
/// times.txt, poses.txt and calib.txt. Fails with kCannotOpen (missing, no permission), kUnusable (no format
/// fits), kUsage (two formats fit).
[[nodiscard]] Expected<std::unique_ptr<Source>> open(const std::filesystem::path& path,
                                                     const OpenOptions& options = {});

/// One file in memory, for tests, fuzzing and streams: the same decoder that open() uses. `name` stands in
/// errors.
[[nodiscard]] Expected<Scan> decode(Bytes bytes, const std::string& name, const OpenOptions& options = {});

}  // namespace verge::io
