// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0

// MCAP against the npm package @mcap/core, both ways. Skipped without node and the packages:
//   npm install @mcap/core @foxglove/rosmsg @foxglove/rosmsg2-serialization @foxglove/crc lz4js fzstd
//   VERGE_NODE_MODULES=$PWD/node_modules
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include <fmt/core.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include "verge/io/file/crc32.hpp"
#include "verge/io/file/mcap.hpp"
#include "verge/io/file/mcap_writer.hpp"
#include "verge/io/file/point_cloud2.hpp"
#include "verge/scan/organise.hpp"

namespace verge::io {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

constexpr std::int64_t kBegin = 1'700'000'000'000'000'000;

/// Whether there is something to compare with; else why not.
std::optional<std::string> missing() {
  const char* modules = std::getenv("VERGE_NODE_MODULES");
  if (modules == nullptr) return "VERGE_NODE_MODULES is not set: @mcap/core is not asked";
  if (!fs::is_directory(fs::path(modules) / "@mcap" / "core"))
    return std::string("no @mcap/core in ") + modules;
  if (std::system("node --version > /dev/null 2>&1") != 0) return "there is no node";
  return std::nullopt;
}

/// What `node mcap_core.mjs ARGUMENTS` prints.
std::string node(const std::string& arguments) {
  const std::string command = fmt::format("node '{}/mcap_core.mjs' {} 2>&1", VERGE_INTEROP_FOLDER, arguments);
  const std::unique_ptr<FILE, int (*)(FILE*)> pipe(::popen(command.c_str(), "r"), &::pclose);
  std::string out;
  for (int c = std::fgetc(pipe.get()); c != EOF; c = std::fgetc(pipe.get()))
    out.push_back(static_cast<char>(c));
  return out;
}

class McapCore : public ::testing::Test {
 protected:
  void SetUp() override {
    if (const auto why = missing()) GTEST_SKIP() << *why;
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  fs::path folder_ = fs::temp_directory_path() / fmt::format("verge-interop-{}", ::getpid());
};

Scan some_scan(int points, std::int64_t stamp_ns) {
  Cloud cloud;
  for (int i = 0; i < points; ++i) {
    cloud.x.push_back(static_cast<float>(10 * std::cos(0.02 * i)));
    cloud.y.push_back(static_cast<float>(10 * std::sin(0.02 * i)));
    cloud.z.push_back(static_cast<float>(i % 4 - 2));
    cloud.ring.push_back(i % 4);
    cloud.time_s.push_back(1e-6 * i);
  }
  Scan scan = organise(std::move(cloud)).scan;
  scan.stamp_ns = stamp_ns;
  scan.frame_id = "lidar";
  scan.T_world_sensor = Pose{};
  return scan;
}

/// The line that mcap_core.mjs has to print of the scan's cloud.
std::string expected_line(const Scan& scan) {
  const std::string message = write_point_cloud2(scan);
  return fmt::format(
      "/points sensor_msgs/msg/PointCloud2 {0} {1} {2} {0} lidar {3} 18 x:0:7,y:4:7,z:8:7,ring:12:4,t:14:6\n",
      *scan.stamp_ns, message.size(), crc32(std::as_bytes(std::span(message))), scan.size());
}

}  // namespace

TEST_F(McapCore, ReadsWhatWeWrite) {
  for (const Packing packing : {Packing::kNone, Packing::kLz4, Packing::kZstd}) {
    std::vector<Scan> scans;
    for (int i = 0; i < 5; ++i) scans.push_back(some_scan(2000 + i, kBegin + 100'000'000LL * i));
    auto writer = McapWriter::create(folder_ / "a.mcap", {.packing = packing, .chunk_bytes = 60'000});
    ASSERT_TRUE(writer);
    for (const Scan& scan : scans) ASSERT_TRUE(writer->add(scan));
    ASSERT_TRUE(writer->finish());
    const std::string printed = node(fmt::format("read '{}'", (folder_ / "a.mcap").string()));
    std::string clouds;  // the lines of the clouds, by the index and then in order
    std::size_t transforms = 0;
    std::istringstream lines(printed);
    for (std::string line; std::getline(lines, line);) {
      if (line.starts_with("/points ")) clouds += line + "\n";
      transforms += line.starts_with("/tf tf2_msgs/msg/TFMessage ") ? 1U : 0U;
    }
    std::string expected;
    for (const Scan& scan : scans) expected += expected_line(scan);
    EXPECT_EQ(clouds, expected + expected) << printed;
    EXPECT_EQ(transforms, 10U) << printed;
  }
}

TEST_F(McapCore, WritesWhatWeRead) {
  for (const std::string kind : {"none", "lz4", "unchunked", "bare"}) {
    const fs::path file = folder_ / (kind + ".mcap");
    ASSERT_EQ(node(fmt::format("write '{}' {}", file.string(), kind)), "");
    auto input = Input::open(file, {});
    ASSERT_TRUE(input);
    auto recording = open_mcap(*std::move(input), {});
    ASSERT_TRUE(recording) << kind << to_string(recording.error());
    for (std::size_t points = 1; points <= 4; ++points) {
      const auto scan = (*recording)->next();
      ASSERT_TRUE(scan && *scan) << kind;
      EXPECT_EQ((*scan)->cloud.x.size(), points);
      EXPECT_EQ((*scan)->cloud.x.back(), static_cast<float>(points));
      EXPECT_EQ((*scan)->cloud.ring.back(), static_cast<std::int64_t>((points - 1) % 4));
      EXPECT_EQ((*scan)->stamp_ns, kBegin + static_cast<std::int64_t>(points));
    }
    const auto end = (*recording)->next();
    EXPECT_TRUE(end && !*end) << kind;
  }
}

}  // namespace verge::io
