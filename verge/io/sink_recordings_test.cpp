// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
//
// Recordings of packets and messages through verge::io::create and back.
#include <algorithm>
#include <cmath>
#include <fstream>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "verge/io/file/pcap.hpp"
#include "verge/io/file/test_captures.hpp"
#include "verge/io/sink.hpp"
#include "verge/io/test_files.hpp"
#include "verge/scan/organise.hpp"
#include "verge/sensor/ibeo/alasca_scan.hpp"
#include "verge/sensor/ibeo/message.hpp"
#include "verge/sensor/ibeo/scan2202.hpp"

namespace verge::io {
namespace {

namespace fs = std::filesystem;

std::string bytes_in(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::ostringstream bytes;
  bytes << in.rdbuf();
  return bytes.str();
}

/// All scans; damage is stepped over.
std::vector<Scan> read_all(const fs::path& path, const OpenOptions& options = {}) {
  std::vector<Scan> scans;
  auto source = open(path, options);
  EXPECT_TRUE(source) << to_string(source.error());
  for (int errors = 0; source && errors < 100;) {
    auto scan = (*source)->next();
    if (!scan) {
      ++errors;
      continue;
    }
    if (!*scan) break;
    if ((*scan)->size() > 0) scans.push_back(*std::move(*scan));
  }
  return scans;
}

/// Writes them; what the sink warned of.
std::string write_all(const fs::path& path, const std::vector<Scan>& scans, SinkOptions options = {}) {
  std::string warnings;
  options.log = [&](LogLevel /*level*/, std::string_view text) { warnings += std::string(text) + '\n'; };
  auto sink = create(path, options);
  EXPECT_TRUE(sink) << to_string(sink.error());
  for (const Scan& scan : scans) {
    const auto written = (*sink)->write(scan);
    EXPECT_TRUE(written) << to_string(written.error());
  }
  EXPECT_TRUE((*sink)->finish());
  return warnings;
}

void expect_same_scans(const std::vector<Scan>& a, const std::vector<Scan>& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    SCOPED_TRACE(i);
    ASSERT_EQ(a[i].size(), b[i].size());
    EXPECT_EQ(a[i].stamp_ns, b[i].stamp_ns);
    EXPECT_EQ(a[i].time_offset_ns, b[i].time_offset_ns);
    EXPECT_TRUE(a[i].x == b[i].x && a[i].y == b[i].y && a[i].z == b[i].z);
    EXPECT_EQ(a[i].intensity, b[i].intensity);
    EXPECT_EQ(a[i].ring_begin, b[i].ring_begin);
    EXPECT_EQ(a[i].echo, b[i].echo);
    EXPECT_EQ(a[i].pulse_width, b[i].pulse_width);
    EXPECT_EQ(a[i].flags, b[i].flags);
    EXPECT_EQ(a[i].input_index, b[i].input_index);
    EXPECT_EQ(a[i].sensor, b[i].sensor);
  }
}

/// Reads, writes, reads again.
void expect_round_trip(const fs::path& path, const std::string& suffix, const OpenOptions& options = {}) {
  const testing::TemporaryFolder folder;
  const fs::path copy = folder.path() / ("copy" + suffix);
  const auto scans = read_all(path, options);
  ASSERT_FALSE(scans.empty());
  EXPECT_EQ(write_all(copy, scans), "");
  expect_same_scans(scans, read_all(copy, options));
}

std::optional<fs::path> data_file(const std::string& name) {
  const auto folder = testing::data_folder();
  if (!folder || !fs::exists(*folder / name)) return std::nullopt;
  return *folder / name;
}

fs::path write_bytes(const testing::TemporaryFolder& folder, const std::string& name,
                     const std::vector<std::byte>& bytes) {
  return folder.write(name, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

namespace ibeo = sensor::ibeo;

/// Scans of a LUX, 20 ms long, that go through all layers, echoes and flags.
std::vector<std::byte> lux_stream(std::size_t scans, const std::vector<std::size_t>& points) {
  constexpr std::uint64_t kNtp = (2'208'988'800ULL + 1'348'258'004ULL) << 32U;  // 2012-09-21
  std::vector<std::byte> stream;
  for (std::size_t n = 0; n < scans; ++n) {
    ibeo::LuxScan scan;
    scan.start_ntp = kNtp + n * ((1ULL << 32U) / 12);
    scan.end_ntp = scan.start_ntp + (1ULL << 32U) / 50;
    scan.start_angle_ticks = 1600;
    scan.end_angle_ticks = -1600;
    for (std::size_t i = 0; i < points[n % points.size()]; ++i) {
      scan.points.push_back({.layer = static_cast<std::uint8_t>(i % 4),
                             .echo = static_cast<std::uint8_t>(i / 4 % 3),
                             .flags = static_cast<std::uint8_t>(1U << (i % 4)),
                             .angle_ticks = static_cast<std::int16_t>(1600 - 4 * static_cast<int>(i % 800)),
                             .range_cm = static_cast<std::uint16_t>(1000 + i),
                             .pulse_width_cm = static_cast<std::uint16_t>(100 + i % 50)});
    }
    const auto message =
        ibeo::encode_message({.type = ibeo::kScanType, .ntp = scan.start_ntp}, ibeo::encode_scan(scan));
    stream.insert(stream.end(), message.begin(), message.end());
  }
  return stream;
}

/// Scans of an ALASCA XT, each layer above the one before.
std::vector<std::byte> alasca_stream(std::size_t scans) {
  std::vector<std::byte> stream;
  for (std::size_t n = 0; n < scans; ++n) {
    ibeo::AlascaScan scan;
    for (int i = 0; i < 400; ++i) {
      const int layer = i % 4;
      const int x_code = 1000 + i;
      scan.points.push_back({.scanner = 0,
                             .layer = static_cast<std::uint8_t>(layer),
                             .echo = static_cast<std::uint8_t>(i % 3),
                             .status = ibeo::AlascaStatus{static_cast<std::uint8_t>(i % 5)},
                             .x_code = static_cast<std::int16_t>(x_code),
                             .y_code = static_cast<std::int16_t>(i - 200),
                             .z_code = static_cast<std::int16_t>(x_code * (2 * layer - 3) / 100),
                             .pulse_width = static_cast<std::uint16_t>(i)});
    }
    const auto message =
        ibeo::encode_alasca_message({.type = ibeo::kAlascaScanType}, ibeo::encode_alasca_scan(scan));
    stream.insert(stream.end(), message.begin(), message.end());
  }
  return stream;
}

}  // namespace

TEST(PcapSink, ACaptureOfOursComesBackByteForByte) {
  const testing::TemporaryFolder folder;
  const auto packets = testing::sensor_packets(600);
  std::string capture = PcapWriter::file_header();
  for (const testing::SensorPacket& packet : packets) {
    capture += PcapWriter::record(testing::bytes_of(packet.payload), packet.time_ns, {});
  }
  const fs::path first = folder.write("first.pcap", capture);
  const auto scans = read_all(first);
  ASSERT_GT(scans.size(), 2U);
  EXPECT_EQ(scans[0].sensor, "hdl32e");
  EXPECT_EQ(write_all(folder.path() / "second.pcap", scans), "");
  const std::string second = bytes_in(folder.path() / "second.pcap");
  ASSERT_EQ(second.size(), capture.size());
  constexpr std::size_t kRecord = 16 + 42 + 1206;
  for (std::size_t i = 0; i < packets.size(); ++i) {
    const std::size_t data = 24 + i * kRecord + 16 + 42;
    ASSERT_TRUE(second.compare(data, 1206, capture, data, 1206) == 0) << i;
  }
  expect_same_scans(scans, read_all(folder.path() / "second.pcap"));
}

TEST(PcapSink, RealRecordingsGiveTheSameClouds) {
  bool any = false;
  for (const char* name : {"sampleShort.pcap", "vlp16/1673400471837873222"}) {
    const auto path = data_file(std::string("velodyne-packets/") + name);
    if (!path) continue;
    any = true;
    SCOPED_TRACE(name);
    expect_round_trip(*path, ".pcap");
  }
  if (!any) GTEST_SKIP() << "no recordings under VERGE_DATA";
}

/// The same, but for what cannot be known: a sensor without a clock is timed by when its packets were
/// received; where the head's azimuth leaps within a packet, what follows comes back at the nearest firing.
void expect_near(const std::string& name, double time_ns, double share_of_range) {
  const auto path = data_file("velodyne-packets/" + name);
  if (!path) GTEST_SKIP() << "no recordings under VERGE_DATA";
  const testing::TemporaryFolder folder;
  const auto scans = read_all(*path);
  EXPECT_EQ(write_all(folder.path() / "copy.pcap", scans), "");
  const auto back = read_all(folder.path() / "copy.pcap");
  ASSERT_EQ(back.size(), scans.size());
  for (std::size_t n = 0; n < scans.size(); ++n) {
    const Scan& a = scans[n];
    const Scan& b = back[n];
    ASSERT_EQ(a.ring_begin, b.ring_begin) << n;
    const std::int64_t later_ns = *b.stamp_ns - *a.stamp_ns;
    const Cloud p = flatten(a);
    const Cloud q = flatten(b);
    const auto order_a = input_order(a);
    const auto order_b = input_order(b);
    for (std::size_t i = 0; i < p.x.size(); ++i) {
      const double near_m = share_of_range * static_cast<double>(a.range[order_a[i]]);
      ASSERT_NEAR(static_cast<double>(p.x[i]), static_cast<double>(q.x[i]), near_m) << n << ' ' << i;
      ASSERT_NEAR(static_cast<double>(p.y[i]), static_cast<double>(q.y[i]), near_m) << n << ' ' << i;
      ASSERT_EQ(p.z[i], q.z[i]);
      ASSERT_EQ(p.intensity[i], q.intensity[i]);
      const auto apart_ns =
          later_ns + std::int64_t{b.time_offset_ns[order_b[i]]} - std::int64_t{a.time_offset_ns[order_a[i]]};
      ASSERT_NEAR(static_cast<double>(apart_ns), 0.0, time_ns) << n << ' ' << i;
    }
  }
}

TEST(PcapSink, ARealSensorWithoutAClockKeepsItsPlacesAndItsTimesNearly) {
  expect_near("atwallshort.pcap", 200'000.0, 0.0);
}

TEST(PcapSink, ARealSensorThatPausesInItsPacketsKeepsItsPointsNearly) {
  constexpr double kHalfAFiringNs = 27'648.0;
  expect_near("vlp32/1713492677464078412", kHalfAFiringNs, 1e-3);
}

TEST(PcapSink, ScansWithoutASensorNeedAModel) {
  const testing::TemporaryFolder folder;
  Scan scan = organise(Cloud{.x = {5.0F}, .y = {0.0F}, .z = {0.0F}, .ring = {0}}).scan;
  auto sink = create(folder.path() / "a.pcap");
  ASSERT_TRUE(sink);
  const auto written = (*sink)->write(scan);
  ASSERT_FALSE(written);
  EXPECT_EQ(written.error().code, ErrorCode::kUsage);
  EXPECT_NE(written.error().need.find("--model"), std::string::npos);
}

TEST(PcapSink, PointsWithoutTimesGetThoseOfAHeadThatTurnsEvenly) {
  const testing::TemporaryFolder folder;
  std::string capture = PcapWriter::file_header();
  for (const testing::SensorPacket& packet : testing::sensor_packets(600)) {
    capture += PcapWriter::record(testing::bytes_of(packet.payload), packet.time_ns, {});
  }
  std::vector<Scan> scans = read_all(folder.write("first.pcap", capture));
  scans.resize(2);
  for (Scan& scan : scans) scan.time_offset_ns.clear();
  write_all(folder.path() / "second.pcap", scans);
  const auto back = read_all(folder.path() / "second.pcap");
  std::size_t before = 0;
  std::size_t after = 0;
  for (const Scan& scan : scans) before += scan.size();
  for (const Scan& scan : back) after += scan.size();
  // Firings of the two heads fall between each other's: some shots share one.
  EXPECT_LE(after, before);
  EXPECT_GE(static_cast<double>(after), 0.99 * static_cast<double>(before));
}

TEST(PcapSink, WhatTheSensorCannotHaveSeenIsCountedInOneLine) {
  const testing::TemporaryFolder folder;
  Cloud cloud{.x = {5.0F, 5.0F, 500.0F}, .y = {0.0F, 1.0F, 0.0F}, .z = {0.0F, 9.0F, 0.0F}};
  cloud.ring = {0, 1, 0};
  const std::string warnings =
      write_all(folder.path() / "a.pcap", {organise(cloud).scan}, {.model = "hdl32e"});
  EXPECT_NE(warnings.find("2 of 3 points are left out"), std::string::npos) << warnings;
  EXPECT_EQ(std::count(warnings.begin(), warnings.end(), '\n'), 1);
}

TEST(PcapSink, TimesThatACaptureCannotSayAreRefusedAndTheOldFileStays) {
  const testing::TemporaryFolder folder;
  const fs::path file = folder.write("a.pcap", "old");
  Scan scan = organise(Cloud{.x = {5.0F}, .y = {0.0F}, .z = {0.0F}, .ring = {0}}).scan;
  for (const std::int64_t stamp_ns : {std::int64_t{-1}, std::int64_t{4'300'000'000'000'000'000}}) {
    scan.stamp_ns = stamp_ns;
    auto sink = create(file, {.model = "hdl32e"});
    ASSERT_TRUE(sink);
    const auto written = (*sink)->write(scan);
    ASSERT_FALSE(written);
    EXPECT_EQ(written.error().code, ErrorCode::kCannotWrite);
  }
  EXPECT_EQ(bytes_in(file), "old");
}

TEST(IdcSink, AStreamBecomesAClosedFileOfTheSameScans) {
  const testing::TemporaryFolder folder;
  const fs::path stream = write_bytes(folder, "stream.bin", lux_stream(5, {740, 33, 1}));
  expect_round_trip(stream, ".idc");
  const auto scans = read_all(stream);
  EXPECT_EQ(scans[0].sensor, "lux");
  write_all(folder.path() / "a.idc", scans);
  write_all(folder.path() / "b.idc", read_all(folder.path() / "a.idc"));
  EXPECT_TRUE(bytes_in(folder.path() / "a.idc") == bytes_in(folder.path() / "b.idc"));
}

TEST(IdcSink, RealStreamsComeBackInAllColumns) {
  bool any = false;
  for (const char* name : {"20120921-200644_record.log.bin", "20120921-200352_record.log.bin"}) {
    const auto path = data_file(std::string("ldmrs-stream/") + name);
    if (!path) continue;
    any = true;
    expect_round_trip(*path, ".idc");
  }
  if (!any) GTEST_SKIP() << "no recordings under VERGE_DATA";
}

TEST(IdcSink, ScansThatTheMessagesCannotSayAreRefused) {
  const testing::TemporaryFolder folder;
  Cloud cloud;
  for (int i = 0; i < 65'536; ++i) {
    cloud.x.push_back(10.0F);
    cloud.y.push_back(1e-4F * static_cast<float>(i));
    cloud.z.push_back(-0.0698F);
    cloud.ring.push_back(0);
  }
  const Scan crowded = organise(cloud).scan;
  Scan early = organise(Cloud{.x = {5.0F}, .y = {0.0F}, .z = {0.0F}, .ring = {0}}).scan;
  early.stamp_ns = -5;
  for (const Scan& scan : {crowded, early}) {
    auto sink = create(folder.path() / "a.idc");
    ASSERT_TRUE(sink);
    const auto written = (*sink)->write(scan);
    ASSERT_FALSE(written);
    EXPECT_EQ(written.error().code, ErrorCode::kCannotWrite);
  }
  EXPECT_FALSE(fs::exists(folder.path() / "a.idc"));
}

TEST(IdcSink, AnotherSensorsModelIsAUsageError) {
  const testing::TemporaryFolder folder;
  const auto sink = create(folder.path() / "a.idc", {.model = "vlp16"});
  ASSERT_FALSE(sink);
  EXPECT_EQ(sink.error().code, ErrorCode::kUsage);
}

TEST(AlascaSink, AStreamComesBackInAllColumns) {
  const testing::TemporaryFolder folder;
  const fs::path stream = write_bytes(folder, "stream.alasca", alasca_stream(3));
  expect_round_trip(stream, ".alasca");
  EXPECT_EQ(read_all(stream).at(0).sensor, "alasca_xt");
}

TEST(McapSink, PointsComeBackInTheOrderOfTheInputWithAllTheirColumns) {
  const testing::TemporaryFolder folder;
  auto scans = read_all(write_bytes(folder, "stream.bin", lux_stream(2, {740})));
  for (Scan& scan : scans) scan.sensor.clear();  // a cloud of ROS does not name it
  write_all(folder.path() / "a.mcap", scans);
  expect_same_scans(scans, read_all(folder.path() / "a.mcap"));
}

}  // namespace verge::io
