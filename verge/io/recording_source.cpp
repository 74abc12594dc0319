// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/io/recording_source.hpp"

#include <cstddef>
#include <optional>
#include <utility>

#include <fmt/core.h>

#include "verge/io/notes.hpp"

namespace verge::io {
namespace {

class RecordingSource final : public Source {
 public:
  RecordingSource(std::unique_ptr<Recording> recording, SourceInfo info, OpenOptions options)
      : recording_(std::move(recording)), info_(std::move(info)), options_(std::move(options)) {}

  [[nodiscard]] Expected<std::optional<Scan>> next() override;
  [[nodiscard]] const SourceInfo& info() const override { return info_; }
  [[nodiscard]] std::vector<Counter> counters() const override { return recording_->counters(); }

 private:
  [[nodiscard]] Expected<void> skip_to_begin();
  [[nodiscard]] Scan scan_of(Decoded decoded);

  std::unique_ptr<Recording> recording_;
  SourceInfo info_;
  OpenOptions options_;
  std::size_t next_ = 0;  // place of the recording's next scan
  Notes notes_;
};

/// Damage before the frames asked for is nobody's business.
Expected<void> RecordingSource::skip_to_begin() {
  while (next_ < options_.frames_begin) {
    const auto skipped = recording_->next();
    if (!skipped) continue;
    if (!*skipped) break;
    ++next_;
  }
  return {};
}

Scan RecordingSource::scan_of(Decoded decoded) {
  const std::string& file = info_.files.empty() ? std::string() : info_.files.front().string();
  for (const std::string& text : decoded.notes) notes_.once(options_.log, file, text);
  Organised organised = organise(std::move(decoded.cloud));
  notes_.rings(options_.log, file, organised);
  Scan scan = std::move(organised.scan);
  scan.frame = fmt::format("{:06}", next_);
  scan.sensor = std::move(decoded.sensor);
  if (!decoded.frame_id.empty()) scan.frame_id = std::move(decoded.frame_id);
  if (decoded.stamp_ns) scan.stamp_ns = decoded.stamp_ns;
  scan.motion = decoded.motion;
  scan.T_world_sensor = decoded.T_world_sensor;
  return scan;
}

Expected<std::optional<Scan>> RecordingSource::next() {
  if (auto skipped = skip_to_begin(); !skipped) return Unexpected(std::move(skipped).error());
  if (options_.frames_end && next_ >= *options_.frames_end) return std::nullopt;
  auto decoded = recording_->next();
  if (!decoded) return Unexpected(std::move(decoded).error());
  if (!*decoded) return std::nullopt;
  Scan scan = scan_of(*std::move(*decoded));
  ++next_;
  return scan;
}

}  // namespace

std::unique_ptr<Source> source_of(std::unique_ptr<Recording> recording, SourceInfo info,
                                  OpenOptions options) {
  return std::make_unique<RecordingSource>(std::move(recording), std::move(info), std::move(options));
}

}  // namespace verge::io
