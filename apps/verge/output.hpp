// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "verge/core/atomic_file.hpp"
#include "verge/core/error.hpp"
#include "verge/emit/geojson.hpp"
#include "verge/pipeline/run.hpp"
#include "verge/pipeline/summary.hpp"

namespace verge::app {

/// Where results go, as the command line says it.
struct OutputRequest {
  std::string jsonl = "-";                       ///< -o: JSON lines; "-" is standard output.
  std::optional<std::filesystem::path> geojson;  ///< --geojson FILE.
  std::optional<std::string> origin;             ///< --origin LAT,LON,HEADING.
};

/// What stands beside the counts in OUT.summary.json. No wall-clock time: same input, same bytes.
struct Provenance {
  std::string method;
  std::string config_hash;
};

/// The files of one run. They appear with finish() and not before; standard output, pipes and devices get
/// every record at once. One thread at a time is let in.
class Output {
 public:
  Output() = default;
  Output(const Output&) = delete;
  Output& operator=(const Output&) = delete;
  ~Output() = default;

  /// Makes every target now, so that a folder that cannot be written ends the run before any work. Fails with
  /// kCannotWrite, or kUsage for an origin that is none.
  [[nodiscard]] static Expected<std::unique_ptr<Output>> open(const OutputRequest& request,
                                                              Provenance provenance);

  /// Takes the record of a frame. Where the reader of standard output has gone, the other outputs go on; with
  /// no others it fails with kReaderGone.
  [[nodiscard]] Expected<void> write(const pipeline::Frame& frame, const std::string& record);
  void count_damaged();

  /// All files appear, with the summary last. Call once; later calls do nothing.
  [[nodiscard]] Expected<void> finish(bool interrupted, const std::vector<Mount>& mounts);

  [[nodiscard]] pipeline::Counts counts() const;

 private:
  [[nodiscard]] Expected<void> write_record(const std::string& record);
  [[nodiscard]] std::string summary(bool interrupted, const std::vector<Mount>& mounts) const;

  mutable std::mutex mutex_;
  Provenance provenance_;
  std::optional<AtomicFile> jsonl_;  ///< None once its reader has gone.
  std::optional<AtomicFile> summary_;
  std::optional<emit::GeoJsonWriter> geojson_;
  pipeline::Counts counts_;
  bool finished_ = false;
};

}  // namespace verge::app
