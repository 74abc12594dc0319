// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0

// What a simulated sensor saw against what is read of its recording: the same to the steps of the wire.
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include "verge/io/sink.hpp"
#include "verge/io/source.hpp"
#include "verge/scan/organise.hpp"
#include "verge/sim/drive.hpp"
#include "verge/sim/ready.hpp"
#include "verge/sim/sensors.hpp"

namespace verge {
namespace {

namespace fs = std::filesystem;

constexpr std::int64_t kBeginNs = 1'767'258'000'000'000'000;
constexpr std::uint64_t kScans = 2;

/// A sensor, the format of its recordings, and the steps of these.
struct Wire {
  std::string sensor;
  io::Format format;
  double range_m;      // a step of its ranges, or of its coordinates
  double azimuth_rad;  // a step of its azimuths
  std::int64_t time_ns;
};

constexpr double kHundredthDeg = 1.7453e-4;

std::vector<Wire> wires() {
  std::vector<Wire> all;
  for (const char* name : {"hdl32e", "vlp16", "hdl64e", "hdl64e-s1", "hdl64e-s3"}) {
    all.push_back({name, io::Format::kPcap, 0.002, kHundredthDeg, 1000});
  }
  all.push_back({"vlp32c", io::Format::kPcap, 0.004, kHundredthDeg, 1000});
  all.push_back({"lux", io::Format::kIbeo, 0.01, 0.0, 1});
  all.push_back({"lux-constant", io::Format::kIbeo, 0.01, 0.0, 1});
  all.push_back({"alasca_xt", io::Format::kAlasca, 0.01, 0.0, 0});
  return all;
}

/// A folder that goes with its object.
class Folder {
 public:
  Folder() {
    std::string name = (fs::temp_directory_path() / "verge_simulated_XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) std::abort();
    path_ = name;
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  ~Folder() { fs::remove_all(path_); }
  [[nodiscard]] const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

std::vector<Scan> simulate(const Wire& wire, const sim::Weather& weather = {}) {
  sim::DriveConfig config;
  config.scenario = sim::ready_scenario(wire.format == io::Format::kPcap ? "campus" : "paper1-r3-v30");
  config.scenario.weather = weather;
  config.sensor = sim::sensor_named(wire.sensor);
  config.stamp_begin_ns = kBeginNs;
  if (wire.format != io::Format::kPcap) config.noise.beam_rays = 3;  // several echoes
  const sim::Drive drive(config);
  std::vector<Scan> scans;
  for (std::uint64_t i = 0; i < kScans; ++i) scans.push_back(drive.scan(i).scan);
  return scans;
}

/// Writes them; what the sink warned of.
std::string write_all(const fs::path& path, const std::vector<Scan>& scans, io::Format format) {
  std::string warnings;
  io::SinkOptions options{.format = format, .position_packets = true};
  options.log = [&](LogLevel /*level*/, std::string_view text) { warnings += std::string(text) + '\n'; };
  auto sink = io::create(path, options);
  EXPECT_TRUE(sink) << to_string(sink.error());
  for (const Scan& scan : scans) {
    const auto written = (*sink)->write(scan);
    EXPECT_TRUE(written) << to_string(written.error());
  }
  EXPECT_TRUE((*sink)->finish());
  return warnings;
}

std::vector<Scan> read_all(const fs::path& path, const std::string& model) {
  std::vector<Scan> scans;
  io::OpenOptions options;
  options.model = model;  // packets of an HDL-64E do not say their series
  auto source = io::open(path, options);
  EXPECT_TRUE(source) << to_string(source.error());
  while (source) {
    auto scan = (*source)->next();
    EXPECT_TRUE(scan) << to_string(scan.error());
    if (!scan || !*scan) break;
    // The last packet is filled up with blocks without returns, which begin another revolution.
    if ((*scan)->size() > 0) scans.push_back(*std::move(*scan));
  }
  return scans;
}

/// The points of all scans as the sensor sent them.
struct Sent {
  Cloud cloud;
  std::vector<std::int64_t> time_ns;
};

Sent sent(const std::vector<Scan>& scans) {
  Sent all;
  for (const Scan& scan : scans) {
    const std::vector<std::uint32_t> ring = ring_of_points(scan);
    for (const std::uint32_t i : input_order(scan)) {
      all.cloud.x.push_back(scan.x[i]);
      all.cloud.y.push_back(scan.y[i]);
      all.cloud.z.push_back(scan.z[i]);
      all.cloud.ring.push_back(ring[i]);
      if (!scan.echo.empty()) all.cloud.echo.push_back(scan.echo[i]);
      if (!scan.flags.empty()) all.cloud.flags.push_back(scan.flags[i]);
      if (!scan.pulse_width.empty()) all.cloud.pulse_width.push_back(scan.pulse_width[i]);
      if (!scan.intensity.empty()) all.cloud.intensity.push_back(scan.intensity[i]);
      if (!scan.time_offset_ns.empty()) all.time_ns.push_back(*scan.stamp_ns + scan.time_offset_ns[i]);
    }
  }
  return all;
}

Vec3 point(const Cloud& cloud, std::size_t i) { return {cloud.x[i], cloud.y[i], cloud.z[i]}; }

void expect_alike(const Sent& simulated, const Sent& read, const Wire& wire) {
  ASSERT_EQ(read.cloud.x.size(), simulated.cloud.x.size());
  for (std::size_t i = 0; i < read.cloud.x.size(); ++i) {
    const Vec3 p = point(simulated.cloud, i);
    // Half a step of range or of each coordinate, and a step of azimuth, which may be missing between the
    // last block of a packet and the next packet's first.
    const double tolerance = 0.87 * wire.range_m + wire.azimuth_rad * norm(p.xy()) + 1e-5;
    ASSERT_LE(norm(point(read.cloud, i) - p), tolerance) << "point " << i << " at " << norm(p) << " m";
    ASSERT_EQ(read.cloud.ring[i], simulated.cloud.ring[i]) << "point " << i;
    if (!read.time_ns.empty()) {
      ASSERT_LE(std::abs(read.time_ns[i] - simulated.time_ns[i]), wire.time_ns) << "point " << i;
    }
  }
  EXPECT_EQ(read.cloud.echo, simulated.cloud.echo);
  EXPECT_EQ(read.cloud.flags, simulated.cloud.flags);
  EXPECT_EQ(read.cloud.intensity, simulated.cloud.intensity);
}

fs::path recording(const Folder& folder, const Wire& wire) {
  const char* suffix = wire.format == io::Format::kPcap   ? "pcap"
                       : wire.format == io::Format::kIbeo ? "idc"
                                                          : "alasca";
  return folder.path() / fmt::format("{}.{}", wire.sensor, suffix);
}

std::string bytes_in(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::ostringstream bytes;
  bytes << in.rdbuf();
  return bytes.str();
}

TEST(SimulatedRecordings, DecodedTheyAreTheSimulatedScansToTheStepsOfTheWire) {
  for (const Wire& wire : wires()) {
    SCOPED_TRACE(wire.sensor);
    const Folder folder;
    const std::vector<Scan> scans = simulate(wire);
    EXPECT_EQ(write_all(recording(folder, wire), scans, wire.format), "");
    const std::vector<Scan> read = read_all(recording(folder, wire), scans[0].sensor);
    ASSERT_EQ(read.size(), scans.size());
    for (std::size_t i = 0; i < scans.size(); ++i) {
      EXPECT_EQ(read[i].size(), scans[i].size()) << "a label beside a scan names its points by their places";
    }
    expect_alike(sent(scans), sent(read), wire);
  }
}

TEST(SimulatedRecordings, OneAndManyThreadsGiveTheSameBytesInAnyWeather) {
  const sim::Weather bad{.rain_mmph = 20.0, .wet_road = 0.5, .dirt = 0.1, .bloom_mrad = 5.0};
  const tbb::global_control allow(tbb::global_control::max_allowed_parallelism, 8);
  for (const Wire& wire : {wires()[0], wires()[6], wires()[8]}) {
    SCOPED_TRACE(wire.sensor);
    const auto bytes_with = [&](int threads) {
      const Folder folder;
      tbb::task_arena arena(threads);
      const std::vector<Scan> scans = arena.execute([&] { return simulate(wire, bad); });
      write_all(recording(folder, wire), scans, wire.format);
      return bytes_in(recording(folder, wire));
    };
    const std::string one = bytes_with(1);
    EXPECT_GT(one.size(), 1000U);
    EXPECT_EQ(bytes_with(7), one);
  }
}

}  // namespace
}  // namespace verge
