// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0

// Speed of reading every format, from memory to clouds: bytes_per_second is of the file, x_floor the ratio of
// the medians of reading and of the floor (bench/floor.hpp) over the same points, measured in turn.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <benchmark/benchmark.h>
#include <fmt/format.h>
#include <unistd.h>

#include "bench/floor.hpp"
#include "bench/measure.hpp"
#include "verge/io/file/alasca_stream.hpp"
#include "verge/io/file/csv.hpp"
#include "verge/io/file/ibeo_stream.hpp"
#include "verge/io/file/kitti.hpp"
#include "verge/io/file/las.hpp"
#include "verge/io/file/mcap.hpp"
#include "verge/io/file/nuscenes.hpp"
#include "verge/io/file/pcap.hpp"
#include "verge/io/file/pcd.hpp"
#include "verge/io/file/ply.hpp"
#include "verge/io/file/rosbag1.hpp"
#include "verge/io/file/rosbag2.hpp"
#include "verge/io/file/test_bags.hpp"
#include "verge/io/sink.hpp"
#include "verge/scan/organise.hpp"
#include "verge/scan/test_clouds.hpp"
#include "verge/sensor/ibeo/test_messages.hpp"
#include "verge/sensor/velodyne/test_packets.hpp"

namespace verge::bench {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kScans = 10;  // of a recording

Bytes bytes_of(const std::string& text) { return std::as_bytes(std::span(text.data(), text.size())); }

/// The clouds of a file in memory; none where it cannot be read.
using Reader = std::function<std::vector<Cloud>(const std::string& file)>;

Reader scan_reader(Expected<io::Decoded> (*read)(io::Input&)) {
  return [read](const std::string& file) {
    io::Input input = io::Input::of(bytes_of(file), "bench");
    auto decoded = read(input);
    std::vector<Cloud> clouds;
    if (decoded) clouds.push_back(std::move(decoded->cloud));
    return clouds;
  };
}

Reader recording_reader(Expected<std::unique_ptr<io::Recording>> (*open)(io::Input,
                                                                         const io::RecordingOptions&)) {
  return [open](const std::string& file) {
    std::vector<Cloud> clouds;
    auto recording = open(io::Input::of(bytes_of(file), "bench"), {});
    while (recording) {
      auto scan = (*recording)->next();
      if (!scan || !*scan) break;
      clouds.push_back(std::move((*scan)->cloud));
    }
    return clouds;
  };
}

void read_beside_floor(benchmark::State& state, const std::string& file, const Reader& reader) {
  Floor floor;
  std::vector<double> ours;
  std::vector<double> floors;
  for ([[maybe_unused]] auto _ : state) {
    const double begin = thread_seconds();
    const std::vector<Cloud> clouds = reader(file);
    ours.push_back(thread_seconds() - begin);
    state.SetIterationTime(ours.back());
    if (clouds.empty()) {
      state.SkipWithError("cannot be read");
      return;
    }
    const double floor_begin = thread_seconds();
    for (const Cloud& cloud : clouds) benchmark::DoNotOptimize(floor.run(cloud.x, cloud.y, cloud.z));
    floors.push_back(thread_seconds() - floor_begin);
  }
  state.SetBytesProcessed(static_cast<std::int64_t>(file.size()) * static_cast<std::int64_t>(ours.size()));
  state.counters["x_floor"] = typical(ours) / typical(floors);
  state.counters["MB"] = 1e-6 * static_cast<double>(file.size());
}

// --- The files. ---

/// What the sink makes of these scans, as bytes.
std::string written(const std::string& name, const std::vector<Scan>& scans) {
  const fs::path path = fs::temp_directory_path() / fmt::format("verge-bench-{}-{}", ::getpid(), name);
  auto sink = io::create(path);
  bool good = sink.has_value();
  for (const Scan& scan : scans) good = good && (*sink)->write(scan);
  good = good && (*sink)->finish();
  std::ifstream in(path, std::ios::binary);
  std::string bytes((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
  std::error_code ignored;
  fs::remove(path, ignored);
  return good ? bytes : std::string();
}

std::string ascii_pcd(const Scan& scan) {
  std::string text = fmt::format(
      "FIELDS x y z intensity ring\nSIZE 4 4 4 4 2\nTYPE F F F F U\nPOINTS {}\nDATA ascii\n", scan.size());
  const std::vector<std::uint32_t> rings = ring_of_points(scan);
  for (std::size_t i = 0; i < scan.size(); ++i) {
    text += fmt::format("{} {} {} {} {}\n", scan.x[i], scan.y[i], scan.z[i], scan.intensity[i], rings[i]);
  }
  return text;
}

/// binary_compressed: the columns one behind the other, as LZF's runs of literals.
std::string compressed_pcd(const Scan& scan) {
  constexpr std::size_t kLongestRun = 32;
  std::string columns;
  for (const auto* column : {&scan.x, &scan.y, &scan.z, &scan.intensity}) {
    columns.append(reinterpret_cast<const char*>(column->data()), column->size() * sizeof(float));
  }
  std::string packed;
  for (std::size_t at = 0; at < columns.size(); at += kLongestRun) {
    const std::size_t run = std::min(kLongestRun, columns.size() - at);
    packed += static_cast<char>(run - 1);
    packed.append(columns, at, run);
  }
  return fmt::format(
             "FIELDS x y z intensity\nSIZE 4 4 4 4\nTYPE F F F F\nPOINTS {}\nDATA binary_compressed\n",
             scan.size()) +
         testing::le(static_cast<std::uint32_t>(packed.size())) +
         testing::le(static_cast<std::uint32_t>(columns.size())) + packed;
}

std::string capture() {
  std::string bytes = io::PcapWriter::file_header();
  for (const auto& packet : sensor::velodyne::testing::stream({.packets = 181 * kScans})) {
    bytes += io::PcapWriter::record(packet.bytes, packet.time_ns, {});
  }
  return bytes;
}

std::string messages(const std::function<std::vector<std::byte>(std::uint16_t)>& message) {
  std::string bytes;
  for (std::uint16_t n = 0; n < 10 * kScans; ++n) {
    const std::vector<std::byte> one = message(n);
    bytes.append(reinterpret_cast<const char*>(one.data()), one.size());
  }
  return bytes;
}

/// Clouds of a scan's x, y, z and rings, as messages of a bag.
std::vector<testing::TestMessage> cloud_messages(const Scan& scan, io::Wire wire) {
  const std::vector<std::uint32_t> rings = ring_of_points(scan);
  testing::CloudParts parts;
  parts.width = static_cast<std::uint32_t>(scan.size());
  parts.fields = {{"x", 0}, {"y", 4}, {"z", 8}, {"ring", 12, 4}};
  parts.point_step = 14;
  parts.row_step = parts.point_step * parts.width;
  for (std::size_t i = 0; i < scan.size(); ++i) {
    for (const float value : {scan.x[i], scan.y[i], scan.z[i]}) parts.data += testing::le(value);
    parts.data += testing::le(static_cast<std::uint16_t>(rings[i]));
  }
  std::vector<testing::TestMessage> all;
  for (std::size_t n = 0; n < kScans; ++n) {
    parts.stamp_ns += 100'000'000;
    all.push_back(
        {"/points", "sensor_msgs/msg/PointCloud2", parts.stamp_ns, testing::cloud_message(parts, wire)});
  }
  return all;
}

void add(const char* name, std::string file, Reader reader) {
  benchmark::RegisterBenchmark(name, [file = std::move(file), reader = std::move(reader)](
                                         benchmark::State& state) { read_beside_floor(state, file, reader); })
      ->UseManualTime()
      ->Unit(benchmark::kMillisecond);
}

void add_all() {
  // What an HDL-64E gives in a turn.
  Scan scan = organise(testing::simulate(testing::plan(64, -24.8, 2.0, 1900))).scan;
  scan.frame = "000000";
  scan.stamp_ns = 1'700'000'000'000'000'000;
  add("kitti", written("a.bin", {scan}), scan_reader(&io::read_kitti));
  add("nuscenes", written("a.pcd.bin", {scan}), scan_reader(&io::read_nuscenes));
  add("pcd binary", written("a.pcd", {scan}), scan_reader(&io::read_pcd));
  add("pcd ascii", ascii_pcd(scan), scan_reader(&io::read_pcd));
  add("pcd binary_compressed", compressed_pcd(scan), scan_reader(&io::read_pcd));
  add("ply", written("a.ply", {scan}), scan_reader(&io::read_ply));
  add("csv", written("a.csv", {scan}), scan_reader(&io::read_csv));
  add("las", written("a.las", {scan}), scan_reader(&io::read_las));
  add("pcap", capture(), recording_reader(&io::open_pcap));
  add("ibeo", messages([](std::uint16_t n) { return testing::lux_scan_message(1000, n); }),
      recording_reader(&io::open_ibeo));
  add("alasca", messages([](std::uint16_t /*n*/) { return testing::alasca_scan_message(1000); }),
      recording_reader(&io::open_alasca));
  add("bag", testing::rosbag1_of(cloud_messages(scan, io::Wire::kRos1)), recording_reader(&io::open_rosbag1));
  add("db3", testing::db3_of(cloud_messages(scan, io::Wire::kCdr)), recording_reader(&io::open_db3));
  add("mcap", written("a.mcap", std::vector<Scan>(kScans, scan)), recording_reader(&io::open_mcap));
}

}  // namespace
}  // namespace verge::bench

int main(int argc, char** argv) { return verge::bench::run_benchmarks(argc, argv, &verge::bench::add_all); }
