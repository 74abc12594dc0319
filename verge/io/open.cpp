// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cerrno>
#include <cstring>
#include <numeric>
#include <string_view>
#include <utility>

#include <fmt/core.h>
#include <sys/stat.h>

#include "verge/io/decode.hpp"
#include "verge/io/file/alasca_stream.hpp"
#include "verge/io/file/ibeo_stream.hpp"
#include "verge/io/file/mcap.hpp"
#include "verge/io/file/pcap.hpp"
#include "verge/io/file/rosbag1.hpp"
#include "verge/io/file/rosbag2.hpp"
#include "verge/io/files.hpp"
#include "verge/io/formats.hpp"
#include "verge/io/kitti_sequence.hpp"
#include "verge/io/notes.hpp"
#include "verge/io/nuscenes_tables.hpp"
#include "verge/io/recording_source.hpp"
#include "verge/io/sniff.hpp"
#include "verge/io/source.hpp"

namespace verge::io {
namespace fs = std::filesystem;
namespace {

InputLimits limits_of(const OpenOptions& options) { return {options.memory_max_bytes, options.timeout_ms}; }

/// Files, each with one scan.
class FileSource final : public Source {
 public:
  FileSource(OpenOptions options, SourceInfo info) : options_(std::move(options)), info_(std::move(info)) {}

  [[nodiscard]] Expected<std::optional<Scan>> next() override;
  [[nodiscard]] const SourceInfo& info() const override { return info_; }

  /// The first file, which opening has read already: a pipe can be read but once.
  void hold(Input first) { first_ = std::move(first); }
  /// What stands beside the files; rows[i] belongs to file i.
  void attach(ScanTrack sequence, std::vector<std::size_t> rows) {
    sequence_ = std::move(sequence);
    rows_ = std::move(rows);
  }

 private:
  [[nodiscard]] Expected<Input> open_next();
  void report(const DecodedScan& decoded, const fs::path& file);

  OpenOptions options_;
  SourceInfo info_;
  ScanTrack sequence_;
  std::vector<std::size_t> rows_;
  std::size_t next_ = 0;
  std::optional<Input> first_;
  Buffer buffer_;
  Notes notes_;
};

Expected<Input> FileSource::open_next() {
  if (next_ == 0 && first_) return std::move(*std::exchange(first_, std::nullopt));
  return Input::open(info_.files[next_], limits_of(options_), std::move(buffer_));
}

void FileSource::report(const DecodedScan& decoded, const fs::path& file) {
  if (name_lies(file, decoded.format)) {
    notes_.once(options_.log, file.string(), fmt::format("is {} by its content", name_of(decoded.format)));
  }
  for (const std::string& text : decoded.notes) notes_.once(options_.log, file.string(), text);
  notes_.rings(options_.log, file.string(), decoded.organised);
}

Expected<std::optional<Scan>> FileSource::next() {
  if (next_ >= info_.files.size()) return std::nullopt;
  auto input = open_next();
  const std::size_t index = next_++;
  if (!input) return Unexpected(input.error());
  auto decoded = decode_input(*input, options_.format, info_.format);
  buffer_ = std::move(*input).take_buffer();
  if (!decoded) return Unexpected(decoded.error());
  report(*decoded, info_.files[index]);
  Scan scan = std::move(decoded->organised.scan);
  if (index < rows_.size()) sequence_.attach(scan, rows_[index]);
  return scan;
}

/// Only the frames asked for.
template <class T>
std::vector<T> slice(const std::vector<T>& all, const OpenOptions& options) {
  const std::size_t end = std::min(options.frames_end.value_or(all.size()), all.size());
  const std::size_t begin = std::min(options.frames_begin, end);
  return {all.begin() + static_cast<std::ptrdiff_t>(begin), all.begin() + static_cast<std::ptrdiff_t>(end)};
}

SourceInfo info_of(Format format, std::vector<fs::path> files) {
  const std::size_t scans = files.size();
  return {format, std::move(files), scans};
}

/// The format of the first file that has one; the first file's trouble where none has.
Expected<Format> first_format(const std::vector<fs::path>& files, const OpenOptions& options) {
  if (options.format) return *options.format;
  std::optional<Error> trouble;
  for (const fs::path& file : files) {
    auto input = Input::open(file, limits_of(options));
    const auto format = input ? sniff(*input) : Expected<Format>(Unexpected(input.error()));
    if (format) return *format;
    if (!trouble) trouble = format.error();
  }
  return Unexpected(*trouble);
}

RecordingOptions recording_options(const OpenOptions& options) {
  return {.topic = options.topic,
          .sensor_ip = options.sensor_ip,
          .model = options.model,
          .calibration = options.calibration,
          .log = options.log};
}

/// Rows of the scans asked for alone.
void attach_nuscenes(FileSource& source, const OpenOptions& options) {
  const std::vector<fs::path>& files = source.info().files;
  std::vector<std::size_t> rows(files.size());
  std::iota(rows.begin(), rows.end(), std::size_t{0});
  source.attach(find_nuscenes_track(files, options.log), std::move(rows));
}

/// A ROS 2 recording is a folder: its files one after the other.
Expected<std::unique_ptr<Source>> open_rosbag2(const fs::path& folder, std::vector<fs::path> files,
                                               const OpenOptions& options) {
  const Format format = format_of_name(files.front()).value_or(Format::kDb3);
  auto recording = open_rosbag2_folder(folder, limits_of(options), recording_options(options));
  if (!recording) return Unexpected(std::move(recording).error());
  return source_of(*std::move(recording), {format, std::move(files), {}}, options);
}

Expected<std::unique_ptr<Source>> open_folder(const fs::path& folder, const OpenOptions& options) {
  if (auto files = find_rosbag2_files(folder); !files.empty()) {
    return open_rosbag2(folder, std::move(files), options);
  }
  auto found = find_scan_files(folder, options.format);
  if (!found) return Unexpected(found.error());
  const auto format = first_format(found->files, options);
  if (!format) return Unexpected(format.error());
  auto source = std::make_unique<FileSource>(options, info_of(*format, slice(found->files, options)));
  if (*format == Format::kKitti) {
    ScanTrack sequence = find_kitti_sequence(found->folder, limits_of(options), options.log);
    const std::size_t rows = std::max(sequence.stamps_ns.size(), sequence.T_world_sensor.size());
    const std::vector<std::size_t> row_of = kitti_rows(found->files, rows);
    if (rows > 0 && row_of.empty()) {
      warn(options.log,
           fmt::format("{} times or poses do not fit {} files: not used", rows, found->files.size()));
    }
    source->attach(std::move(sequence), slice(row_of, options));
  }
  if (*format == Format::kNuscenes) attach_nuscenes(*source, options);
  return source;
}

Expected<std::unique_ptr<Recording>> open_recording(Input input, Format format, const OpenOptions& options) {
  switch (format) {
    case Format::kIbeo:
      return open_ibeo(std::move(input), recording_options(options));
    case Format::kAlasca:
      return open_alasca(std::move(input), recording_options(options));
    case Format::kPcap:
      return open_pcap(std::move(input), recording_options(options));
    case Format::kBag:
      return open_rosbag1(std::move(input), recording_options(options));
    case Format::kDb3:
      return open_db3(std::move(input), recording_options(options));
    case Format::kMcap:
      return open_mcap(std::move(input), recording_options(options));
    default:
      break;
  }
  return Unexpected(
      input.error_at(ErrorCode::kUsage, 0, fmt::format("{} is a scan, not a recording", name_of(format))));
}

Expected<std::unique_ptr<Source>> open_file(const fs::path& path, const OpenOptions& options) {
  auto input = Input::open(path, limits_of(options));
  if (!input) return Unexpected(input.error());
  const auto format = options.format ? Expected<Format>(*options.format) : sniff(*input);
  if (!format) return Unexpected(format.error());
  if (facts_of(*format).many_scans) {
    if (*format == Format::kDb3) warn_of_wal(path, options.log);
    auto recording = open_recording(*std::move(input), *format, options);
    if (!recording) return Unexpected(std::move(recording).error());
    return source_of(*std::move(recording), {*format, {path}, {}}, options);
  }
  auto source = std::make_unique<FileSource>(options, info_of(*format, slice(std::vector{path}, options)));
  if (!source->info().files.empty()) source->hold(std::move(*input));
  if (*format == Format::kKitti) {
    ScanTrack sequence = find_kitti_sequence(path.parent_path(), limits_of(options), options.log);
    const std::size_t rows = std::max(sequence.stamps_ns.size(), sequence.T_world_sensor.size());
    const std::vector<std::size_t> row_of = kitti_rows({path}, rows);
    source->attach(std::move(sequence), slice(row_of, options));
  }
  if (*format == Format::kNuscenes) {
    // The tables are read for a folder alone: they are large, and a shell may name thousands of files.
    if (const auto stamp = nuscenes_stamp_ns(path))
      source->attach({{*stamp}, {}}, slice(std::vector{std::size_t{0}}, options));
  }
  return source;
}

}  // namespace

Expected<std::unique_ptr<Source>> open(const fs::path& path, const OpenOptions& options) {
  struct stat status {};
  if (::stat(path.c_str(), &status) != 0) {
    return Unexpected({ErrorCode::kCannotOpen,
                       path.string(),
                       {},
                       fmt::format("cannot open: {}", std::strerror(errno)),
                       {},
                       {}});
  }
  return S_ISDIR(status.st_mode) ? open_folder(path, options) : open_file(path, options);
}

}  // namespace verge::io
