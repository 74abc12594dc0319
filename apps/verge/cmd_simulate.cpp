// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <system_error>

#include <CLI/CLI.hpp>
#include <fmt/core.h>

#include "apps/verge/commands.hpp"
#include "apps/verge/console.hpp"
#include "apps/verge/number_range.hpp"
#include "apps/verge/options.hpp"
#include "apps/verge/progress.hpp"
#include "apps/verge/signals.hpp"
#include "verge/emit/jsonl_writer.hpp"
#include "verge/io/file/nuscenes.hpp"
#include "verge/sim/drive.hpp"

namespace verge::app {
namespace {

constexpr const char* kExamples =
    "Examples:\n"
    "  verge simulate drive                          # a straight road, then a curve; truth in "
    "drive/truth.jsonl\n"
    "  verge simulate rain --noise-m 0.05 --seed 7   # the same road seen by a worse sensor\n";

enum class RoadKind : std::uint8_t { kStraight, kCurve, kDrive };

struct SimulateRequest {
  std::filesystem::path folder;
  RoadKind road = RoadKind::kDrive;
  std::size_t scans = 120;
  std::uint64_t seed = 1;
  double speed_kmh = 28.8;
  double noise_m = 0.02;
  bool skewed = false;
  Console::Options console;
};

sim::DriveConfig ready_drive(RoadKind kind, double travel_m) {
  switch (kind) {
    case RoadKind::kStraight:
      return sim::straight_road(travel_m);
    case RoadKind::kCurve:
      return sim::curved_road(travel_m);
    case RoadKind::kDrive:
      break;
  }
  return sim::demo_drive(travel_m);
}

sim::DriveConfig drive_of(const SimulateRequest& request) {
  const double speed_mps = request.speed_kmh / 3.6;
  const double seconds = static_cast<double>(request.scans) / sensor::hdl32e().rate_hz;
  sim::DriveConfig config = ready_drive(request.road, speed_mps * seconds);
  config.course.speed_mps = speed_mps;
  config.noise.seed = request.seed;
  config.noise.range_sigma_m = request.noise_m;
  return config;
}

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

/// One drive from its roads to its files.
class SimulateJob {
 public:
  SimulateJob(const SimulateRequest& request, Console& console, const Signals& signals)
      : request_(request), console_(console), signals_(signals), drive_(drive_of(request)) {}

  [[nodiscard]] Expected<void> run() {
    const std::filesystem::path folder = request_.folder / "LIDAR_TOP";
    if (auto made = make_folder(folder); !made) return made;
    auto truth = emit::SceneWriter::open(request_.folder / "truth.jsonl");
    if (!truth) return Unexpected(truth.error());
    for (; done_ < request_.scans && !signals_.stop(); ++done_) {
      sim::Simulated simulated = drive_.scan(done_);
      const Scan scan = request_.skewed ? std::move(simulated.scan) : deskew(std::move(simulated.scan));
      const auto file = folder / (scan.frame + ".pcd.bin");
      if (auto written = io::write_nuscenes(file, scan); !written) return written;
      if (auto written = truth->write(simulated.truth); !written) return written;
      points_ += scan.size();
      console_.progress(progress_line(done_ + 1, request_.scans, seconds()));
    }
    return truth->finish();
  }

  [[nodiscard]] std::string report() const {
    return fmt::format("verge: {} scans with {} points in {:.1f} s: {}, with the truth in {}\n", done_,
                       points_, seconds(), (request_.folder / "LIDAR_TOP").string(),
                       (request_.folder / "truth.jsonl").string());
  }

 private:
  [[nodiscard]] double seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count();
  }

  const SimulateRequest& request_;
  Console& console_;
  const Signals& signals_;
  sim::Drive drive_;
  std::size_t done_ = 0;
  std::size_t points_ = 0;
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
};

ExitCode simulate(const SimulateRequest& request) {
  Console console(request.console);
  const Signals signals;
  SimulateJob job(request, console, signals);
  if (const auto done = job.run(); !done) {
    console.error(done.error());
    return exit_code_of(done.error().code);
  }
  console.print(job.report());
  return signals.stop() ? signals.exit_code() : ExitCode::kOk;
}

void add_options(CLI::App& verb, SimulateRequest& request) {
  const std::map<std::string, RoadKind> roads{
      {"straight", RoadKind::kStraight}, {"curve", RoadKind::kCurve}, {"drive", RoadKind::kDrive}};
  verb.add_option("DIR", request.folder, "new folder for LIDAR_TOP/*.pcd.bin and truth.jsonl")->required();
  verb.add_option("--road", request.road,
                  "straight, curve, or drive: 60 m straight, then curves, with houses")
      ->type_name("ROAD")
      ->transform(CLI::CheckedTransformer(roads).description(""));
  verb.add_option("--scans", request.scans, "how many, at 10 a second")
      ->type_name("N")
      ->capture_default_str()
      ->check(CLI::Range(1, 100'000));
  verb.add_option("--seed", request.seed, "of the noise; the same seed gives the same bytes")
      ->type_name("S")
      ->capture_default_str()
      ->check(finite_range(0.0, 0x1p64));
  verb.add_option("--speed-kmh", request.speed_kmh, "of the vehicle")
      ->type_name("V")
      ->capture_default_str()
      ->check(finite_range(0.0, 200.0));
  verb.add_option("--noise-m", request.noise_m, "deviation of the noise of each range")
      ->type_name("M")
      ->capture_default_str()
      ->check(finite_range(0.0, 1.0));
  verb.add_flag(
      "--skewed", request.skewed,
      "points where the moving sensor saw them; without it the motion is taken out, as in nuScenes");
  add_console_options(verb, request.console);
}

}  // namespace

void add_simulate(CLI::App& program, Action& action) {
  CLI::App* verb = program.add_subcommand("simulate", "drive a made-up road with an HDL-32E on the roof");
  const auto request = std::make_shared<SimulateRequest>();
  add_options(*verb, *request);
  verb->footer(std::string(kExamples) + "\n" + exit_code_help());
  verb->callback([request, &action] { action = [request] { return simulate(*request); }; });
}

}  // namespace verge::app
