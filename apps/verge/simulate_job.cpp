// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "apps/verge/simulate_job.hpp"

#include <chrono>
#include <system_error>
#include <utility>
#include <vector>

#include <fmt/core.h>

#include "apps/verge/progress.hpp"
#include "apps/verge/scenario_file.hpp"
#include "verge/core/atomic_file.hpp"
#include "verge/core/byte_writer.hpp"
#include "verge/emit/bev_plot.hpp"
#include "verge/emit/jsonl_writer.hpp"
#include "verge/io/file/nuscenes.hpp"
#include "verge/scan/organise.hpp"

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

// The labels in the order of the points in the scan's file, as SemanticKITTI stores them.
Expected<void> write_labels(const std::filesystem::path& file, const Scan& scan) {
  ByteWriter writer;
  for (const std::uint32_t label : flatten(scan).label) writer.le(label);
  const std::vector<std::byte> bytes = std::move(writer).take();
  return write_file(file, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

/// One drive from its world to its files.
class SimulateJob {
 public:
  SimulateJob(const SimulateRequest& request, const sim::Drive& drive, std::size_t scans, Console& console,
              const Signals& signals)
      : request_(request), console_(console), signals_(signals), drive_(drive), scans_(scans) {}

  [[nodiscard]] Expected<void> run() {
    for (const auto& folder : {request_.folder / "LIDAR_TOP", request_.folder / "labels"}) {
      if (auto made = make_folder(folder); !made) return made;
    }
    if (request_.plot) {
      if (auto made = make_folder(*request_.plot); !made) return made;
    }
    auto truth = emit::SceneWriter::open(request_.folder / "truth.jsonl");
    if (!truth) return Unexpected(truth.error());
    const std::string scenario = to_toml(drive_.config().scenario);
    if (auto written = write_file(request_.folder / "scenario.toml", scenario); !written) return written;
    for (; done_ < scans_ && !signals_.stop(); ++done_) {
      if (auto written = write_scan(*truth); !written) return written;
      console_.progress(progress_line(done_ + 1, scans_, seconds()));
    }
    return truth->finish();
  }

  [[nodiscard]] std::string report() const {
    return fmt::format("verge: {} scans with {} points in {:.1f} s: {}, with the truth in {}\n", done_,
                       points_, seconds(), (request_.folder / "LIDAR_TOP").string(),
                       (request_.folder / "truth.jsonl").string());
  }

 private:
  [[nodiscard]] Expected<void> write_scan(emit::SceneWriter& truth) {
    sim::Simulated simulated = drive_.scan(done_);
    Scan scan = request_.skewed ? std::move(simulated.scan) : deskew(std::move(simulated.scan));
    const auto labels = request_.folder / "labels" / (scan.frame + ".label");
    if (auto written = write_labels(labels, scan); !written) return written;
    const auto file = request_.folder / "LIDAR_TOP" / (scan.frame + ".pcd.bin");
    if (auto written = io::write_nuscenes(file, scan); !written) return written;
    points_ += scan.size();
    if (request_.plot) {
      scan.mount = simulated.mount;
      const auto picture = *request_.plot / (scan.frame + ".png");
      if (auto drawn = plot_.write(
              picture, {.scan = scan, .scene = simulated.truth, .trace = nullptr, .truth = nullptr});
          !drawn)
        return drawn;
    }
    return truth.write(simulated.truth);
  }

  [[nodiscard]] double seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count();
  }

  const SimulateRequest& request_;
  Console& console_;
  const Signals& signals_;
  const sim::Drive& drive_;
  emit::BevPlot plot_;
  std::size_t scans_;
  std::size_t done_ = 0;
  std::size_t points_ = 0;
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
};

}  // namespace

Expected<void> write_drive(const SimulateRequest& request, const sim::Drive& drive, std::size_t scans,
                           Console& console, const Signals& signals) {
  SimulateJob job(request, drive, scans, console, signals);
  if (auto done = job.run(); !done) return done;
  console.print(job.report());
  return {};
}

}  // namespace verge::app
