// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "apps/verge/simulate_job.hpp"

#include <chrono>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "apps/verge/progress.hpp"
#include "apps/verge/scenario_file.hpp"
#include "verge/core/atomic_file.hpp"
#include "verge/core/byte_writer.hpp"
#include "verge/emit/bev_plot.hpp"
#include "verge/emit/jsonl_writer.hpp"
#include "verge/io/formats.hpp"
#include "verge/io/sink.hpp"
#include "verge/sensor/ibeo/alasca_xt.hpp"
#include "verge/sensor/ibeo/lux.hpp"
#include "verge/sensor/velodyne/facts.hpp"
#include "verge/sim/labels.hpp"

namespace verge::app {
namespace {

Error cannot_write(const std::filesystem::path& path, std::string what) {
  return {ErrorCode::kCannotWrite, path.string(), {}, std::move(what), {}, {}};
}

// The folder for the scans: new or empty, so that no scan of another drive stands among them.
Expected<void> make_folder(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) return Unexpected(cannot_write(folder, error.message()));
  const bool empty = std::filesystem::is_empty(folder, error);
  if (error) return Unexpected(cannot_write(folder, error.message()));
  if (!empty) return Unexpected(cannot_write(folder, "holds files already; name a new or empty folder"));
  return {};
}

Error usage_error(std::string what, std::string got, std::string need) {
  return {ErrorCode::kUsage, {}, {}, std::move(what), std::move(got), std::move(need)};
}

// Whether only one maker's sensors can have made the format, and this is none of them.
bool is_of_another_sensor(io::Format format, const std::string& sensor) {
  switch (format) {
    case io::Format::kPcap:
      return !sensor::velodyne::model_named(sensor);
    case io::Format::kIbeo:
      return sensor != sensor::ibeo::lux().name;
    case io::Format::kAlasca:
      return sensor != sensor::ibeo::alasca_xt().name;
    default:
      return false;
  }
}

// Formats without the times of points: there the motion is taken out, as those data sets do it.
bool is_deskewed(io::Format format) {
  return format == io::Format::kNuscenes || format == io::Format::kKitti;
}

// One recording, a folder of scans as the data set names it, or a folder of files.
std::filesystem::path place_of(io::Format format, const std::filesystem::path& folder) {
  if (format == io::Format::kNuscenes) return folder / "LIDAR_TOP";
  if (format == io::Format::kKitti) return folder;
  const io::FormatFacts& facts = io::facts_of(format);
  return facts.many_scans ? folder / fmt::format("recording{}", facts.suffix) : folder / "scans";
}

/// The labels of the points in the order in which they stand in the recording, as the data sets keep them:
/// nuScenes lidarseg a byte each, else SemanticKITTI's four.
class LabelFiles {
 public:
  LabelFiles(const std::filesystem::path& folder, io::Format format)
      : format_(format),
        nuscenes_(format == io::Format::kNuscenes),
        folder_(folder / (nuscenes_ ? "lidarseg" : "labels")) {}

  [[nodiscard]] Expected<void> make() const { return make_folder(folder_); }

  [[nodiscard]] Expected<void> write(const Scan& scan, const sim::ClassNumbers& numbers) const {
    ByteWriter writer;
    for (const std::uint32_t i : io::written_order(format_, scan)) {
      if (nuscenes_) {
        writer.le(numbers.nuscenes(scan.label[i]));
      } else {
        writer.le(numbers.semantic_kitti(scan.label[i]));
      }
    }
    const std::vector<std::byte> bytes = std::move(writer).take();
    const std::string name = scan.frame + (nuscenes_ ? "_lidarseg.bin" : ".label");
    return write_file(folder_ / name, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
  }

 private:
  io::Format format_;
  bool nuscenes_;
  std::filesystem::path folder_;
};

/// One drive from its world to its files.
class SimulateJob {
 public:
  SimulateJob(const SimulateRequest& request, const sim::Drive& drive, io::Format format, std::size_t scans,
              Console& console, const Signals& signals)
      : request_(request),
        format_(format),
        console_(console),
        signals_(signals),
        drive_(drive),
        scans_(scans),
        labels_(request.folder, format),
        numbers_(drive.things()) {}

  [[nodiscard]] Expected<void> run() {
    if (auto made = labels_.make(); !made) return made;
    if (request_.plot) {
      if (auto made = make_folder(*request_.plot); !made) return made;
    }
    auto sink = io::create(place(), {.format = format_, .position_packets = true, .log = console_.log()});
    if (!sink) return Unexpected(sink.error());
    auto truth = emit::SceneWriter::open(request_.folder / "truth.jsonl");
    if (!truth) return Unexpected(truth.error());
    const std::string scenario = to_toml(drive_.config().scenario);
    if (auto written = write_file(request_.folder / "scenario.toml", scenario); !written) return written;
    for (; done_ < scans_ && !signals_.stop(); ++done_) {
      if (auto written = write_scan(**sink, *truth); !written) return written;
      console_.progress(progress_line(done_ + 1, scans_, seconds()));
    }
    if (auto written = (*sink)->finish(); !written) return written;
    if (auto written = write_file(request_.folder / "poses.csv", poses_); !written) return written;
    return truth->finish();
  }

  [[nodiscard]] std::string report() const {
    return fmt::format("verge: {} scans with {} points in {:.1f} s: {}, with the truth in {}\n", done_,
                       points_, seconds(), place().string(), (request_.folder / "truth.jsonl").string());
  }

 private:
  [[nodiscard]] std::filesystem::path place() const { return place_of(format_, request_.folder); }

  [[nodiscard]] Expected<void> write_scan(io::Sink& sink, emit::SceneWriter& truth) {
    sim::Simulated simulated = drive_.scan(done_);
    const bool skewed = request_.skewed || !is_deskewed(format_);
    Scan scan = skewed ? std::move(simulated.scan) : deskew(std::move(simulated.scan));
    if (auto written = labels_.write(scan, numbers_); !written) return written;
    for (std::uint32_t& label : scan.label) label = numbers_.semantic_kitti(label);
    add_pose(scan);
    if (auto written = sink.write(scan); !written) return written;
    points_ += scan.size();
    if (auto drawn = draw(std::move(scan), simulated); !drawn) return drawn;
    return truth.write(simulated.truth);
  }

  void add_pose(const Scan& scan) {
    const auto& [q, t] = *scan.T_world_sensor;
    poses_ += fmt::format("{},{},{},{},{},{},{},{},{}\n", scan.frame, *scan.stamp_ns, t.x, t.y, t.z, q.w, q.x,
                          q.y, q.z);
  }

  [[nodiscard]] Expected<void> draw(Scan scan, const sim::Simulated& simulated) {
    if (!request_.plot) return {};
    scan.mount = simulated.mount;
    return plot_.write(*request_.plot / (scan.frame + ".png"),
                       {.scan = scan, .scene = simulated.truth, .trace = nullptr, .truth = nullptr});
  }

  [[nodiscard]] double seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count();
  }

  const SimulateRequest& request_;
  io::Format format_;
  Console& console_;
  const Signals& signals_;
  const sim::Drive& drive_;
  emit::BevPlot plot_;
  std::size_t scans_;
  LabelFiles labels_;
  sim::ClassNumbers numbers_;
  std::string poses_ = "frame,stamp_ns,x_m,y_m,z_m,qw,qx,qy,qz\n";
  std::size_t done_ = 0;
  std::size_t points_ = 0;
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
};

}  // namespace

Expected<io::Format> format_of(const std::optional<std::string>& name, const sim::LidarModel& sensor) {
  if (!name) {
    for (const io::Format own : {io::Format::kIbeo, io::Format::kAlasca}) {
      if (!is_of_another_sensor(own, sensor.name)) return own;
    }
    return io::Format::kNuscenes;
  }
  const auto format = *name == "idc" ? io::Format::kIbeo : value_named<io::Format>(*name);
  if (!format || !io::facts_of(*format).written) {
    std::vector<std::string_view> names = {"idc"};
    for (const io::Format known : io::all_formats()) {
      if (io::facts_of(known).written && known != io::Format::kIbeo) names.push_back(io::name_of(known));
    }
    return Unexpected(
        usage_error("no such format", "--format " + *name, fmt::format("{}", fmt::join(names, ", "))));
  }
  if (!is_of_another_sensor(*format, sensor.name)) return *format;
  return Unexpected(usage_error("another maker's sensors record so", "--format " + *name,
                                fmt::format("a format that holds the scans of a {}", sensor.name)));
}

Expected<void> write_drive(const SimulateRequest& request, const sim::Drive& drive, io::Format format,
                           std::size_t scans, Console& console, const Signals& signals) {
  SimulateJob job(request, drive, format, scans, console, signals);
  if (auto done = job.run(); !done) return done;
  console.print(job.report());
  return {};
}

}  // namespace verge::app
