// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/io/sink.hpp"

#include <numeric>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

#include <fmt/core.h>
#include <fmt/ranges.h>

#include "verge/core/atomic_file.hpp"
#include "verge/io/file/csv.hpp"
#include "verge/io/file/ibeo_sink.hpp"
#include "verge/io/file/kitti.hpp"
#include "verge/io/file/las.hpp"
#include "verge/io/file/mcap_writer.hpp"
#include "verge/io/file/nuscenes.hpp"
#include "verge/io/file/pcap_sink.hpp"
#include "verge/io/file/pcd.hpp"
#include "verge/io/file/ply.hpp"
#include "verge/io/formats.hpp"
#include "verge/scan/organise.hpp"

namespace verge::io {
namespace fs = std::filesystem;
namespace {

Error usage_error(const fs::path& path, std::string what, std::string need = {}) {
  return {ErrorCode::kUsage, path.string(), {}, std::move(what), {}, std::move(need)};
}

Expected<void> write_scan(Format format, const fs::path& path, const Scan& scan) {
  switch (format) {
    case Format::kKitti:
      return write_kitti(path, scan);
    case Format::kNuscenes:
      return write_nuscenes(path, scan);
    case Format::kPcd:
      return write_pcd(path, scan);
    case Format::kPly:
      return write_ply(path, scan);
    case Format::kCsv:
      return write_csv(path, scan);
    case Format::kLas:
      return write_las(path, scan);
    default:
      break;
  }
  return Unexpected(usage_error(path, fmt::format("{} is not written", name_of(format))));
}

/// One scan in one file: held until it is known that there is no second one.
class FileSink final : public Sink {
 public:
  FileSink(Format format, fs::path path) : format_(format), path_(std::move(path)) {}

  [[nodiscard]] Expected<void> write(const Scan& scan) override {
    if (scan_) return Unexpected(usage_error(path_, "holds one scan, and there are more", "a folder"));
    scan_ = scan;
    return {};
  }
  [[nodiscard]] Expected<void> finish() override {
    return scan_ ? write_scan(format_, path_, *scan_) : Expected<void>{};
  }

 private:
  Format format_;
  fs::path path_;
  std::optional<Scan> scan_;
};

/// A file for each scan.
class FolderSink final : public Sink {
 public:
  FolderSink(Format format, fs::path folder)
      : format_(format),
        folder_(std::move(folder)),
        scans_(format == Format::kKitti ? folder_ / "velodyne" : folder_) {}

  [[nodiscard]] Expected<void> make_folders() const {
    std::error_code error;
    fs::create_directories(scans_, error);
    if (error) return cannot_write("cannot make the folder", error.message());
    const bool empty = fs::is_empty(scans_, error);
    if (error) return cannot_write("cannot read the folder", error.message());
    if (!empty) return cannot_write("holds files already; name a new or empty folder", {});
    return {};
  }

  [[nodiscard]] Expected<void> write(const Scan& scan) override {
    add_time(scan.stamp_ns);
    add_pose(scan.T_world_sensor);
    // KITTI's times belong to scans by number.
    const std::string name = format_ == Format::kKitti ? fmt::format("{:06}", count_) : scan.frame;
    ++count_;
    return write_scan(format_, scans_ / fmt::format("{}{}", name, facts_of(format_).suffix), scan);
  }
  [[nodiscard]] Expected<void> finish() override {
    if (format_ != Format::kKitti || count_ == 0) return {};
    if (timed_) {
      if (auto written = write_file(folder_ / "times.txt", times_); !written) return written;
    }
    if (!posed_) return {};
    // KITTI's poses are a camera's: here it stands where the sensor stands.
    if (auto written = write_file(folder_ / "calib.txt", "Tr: 1 0 0 0 0 1 0 0 0 0 1 0\n"); !written)
      return written;
    return write_file(folder_ / "poses.txt", poses_);
  }

 private:
  [[nodiscard]] Expected<void> cannot_write(std::string what, std::string got) const {
    return Unexpected({ErrorCode::kCannotWrite, scans_.string(), {}, std::move(what), std::move(got), {}});
  }
  void add_time(std::optional<std::int64_t> stamp_ns) {
    constexpr std::int64_t kSecond = 1'000'000'000;
    timed_ = timed_ && stamp_ns && *stamp_ns >= 0;
    if (timed_) times_ += fmt::format("{}.{:09}\n", *stamp_ns / kSecond, *stamp_ns % kSecond);
  }

  /// A row of KITTI's poses.txt: the matrix [R | t], row by row.
  void add_pose(const std::optional<Pose>& pose) {
    posed_ = posed_ && pose;
    if (!posed_) return;
    const Vec3 x = rotate(pose->rotation, {1.0, 0.0, 0.0});
    const Vec3 y = rotate(pose->rotation, {0.0, 1.0, 0.0});
    const Vec3 z = rotate(pose->rotation, {0.0, 0.0, 1.0});
    const Vec3 t = pose->translation;
    poses_ += fmt::format("{} {} {} {} {} {} {} {} {} {} {} {}\n", x.x, y.x, z.x, t.x, x.y, y.y, z.y, t.y,
                          x.z, y.z, z.z, t.z);
  }

  Format format_;
  fs::path folder_;
  fs::path scans_;
  std::size_t count_ = 0;
  bool timed_ = true;
  std::string times_;
  bool posed_ = true;
  std::string poses_;
};

/// All scans in one recording.
class McapSink final : public Sink {
 public:
  explicit McapSink(McapWriter writer) : writer_(std::move(writer)) {}

  [[nodiscard]] Expected<void> write(const Scan& scan) override { return writer_.add(scan); }
  [[nodiscard]] Expected<void> finish() override { return writer_.finish(); }

 private:
  McapWriter writer_;
};

std::vector<std::string_view> names_that_can_be_written() {
  std::vector<std::string_view> names;
  for (const Format format : all_formats()) {
    if (facts_of(format).written) names.push_back(name_of(format));
  }
  return names;
}

}  // namespace

Expected<std::unique_ptr<Sink>> create(const fs::path& path, const SinkOptions& options) {
  const auto named = format_of_name(path);
  const auto format = options.format ? options.format : named;
  if (!format) {
    return Unexpected(usage_error(path, "the name says no format that can be written",
                                  fmt::format("--to {}", fmt::join(names_that_can_be_written(), ", "))));
  }
  if (!facts_of(*format).written) {
    return Unexpected(usage_error(path, fmt::format("{} is read but not written", name_of(*format)),
                                  fmt::format("{}", fmt::join(names_that_can_be_written(), ", "))));
  }
  if (*format == Format::kPcap) return create_pcap_sink(path, options);
  if (*format == Format::kIbeo) return create_idc_sink(path, options);
  if (*format == Format::kAlasca) return create_alasca_sink(path, options);
  if (*format == Format::kMcap) {
    auto writer = McapWriter::create(path);
    if (!writer) return Unexpected(std::move(writer).error());
    return std::make_unique<McapSink>(*std::move(writer));
  }
  if (named && !fs::is_directory(path)) return std::make_unique<FileSink>(*format, path);
  auto sink = std::make_unique<FolderSink>(*format, path);
  if (auto made = sink->make_folders(); !made) return Unexpected(std::move(made).error());
  return sink;
}

std::vector<std::uint32_t> written_order(Format format, const Scan& scan) {
  if (format == Format::kKitti) return kitti_order(scan);
  if (format != Format::kLas) return input_order(scan);
  std::vector<std::uint32_t> order(scan.size());
  std::iota(order.begin(), order.end(), 0U);
  return order;
}

}  // namespace verge::io
