// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/fuzz/bag_format.hpp"

#include "tests/faults/counter_sums.hpp"

namespace verge::fuzz {
namespace {

constexpr std::int64_t kBegin = 1'700'000'000'000'000'000;

void check_columns(const Cloud& cloud) {
  const std::size_t n = cloud.x.size();
  require(cloud.y.size() == n && cloud.z.size() == n);
  require(cloud.intensity.empty() || cloud.intensity.size() == n);
  require(cloud.ring.empty() || cloud.ring.size() == n);
  require(cloud.time_s.empty() || cloud.time_s.size() == n);
  require(cloud.label.empty() || cloud.label.size() == n);
}

/// What came of it, in short: scans, points, errors.
std::string run(Bytes bytes, OpenRecording open) {
  auto recording = open(io::Input::of(bytes, "fuzz"), {});
  if (!recording) return to_string(recording.error());
  std::string out;
  // Each step takes at least a byte of the input, which may be packed, by up to 1024.
  for (std::size_t steps = 0; steps < 4096 * (bytes.size() + 1024); ++steps) {
    auto next = (*recording)->next();
    if (!next) {
      out += to_string(next.error()) + "\n";
    } else if (*next) {
      check_columns((*next)->cloud);
      out += std::to_string((*next)->cloud.x.size()) + "\n";
    } else {
      const auto again = (*recording)->next();  // the end stays
      require(again && !*again);
      require(faults::add_up((*recording)->counters()));
      return out;
    }
  }
  require(false);
  return out;
}

std::string velodyne_message(io::Wire wire) {
  testing::WireWriter scan(wire);
  scan.header(kBegin, "velodyne").number(std::uint32_t{2});
  for (std::uint32_t p = 0; p < 2; ++p) {
    std::string payload;
    for (std::uint16_t block = 0; block < 12; ++block) {
      payload += "\xFF\xEE" + testing::le(static_cast<std::uint16_t>(17800 + 20 * (12 * p + block)));
      for (int i = 0; i < 32; ++i) payload += testing::le(std::uint16_t{5000}) + "\x20";
    }
    payload += testing::le(1327 * p) + "\x37\x22";
    scan.number(1'700'000'000U).number(1'327'000 * p).raw(payload);
  }
  return scan.bytes();
}

}  // namespace

std::vector<testing::TestMessage> velodyne_messages(io::Wire wire) {
  return {{"/packets", "velodyne_msgs/msg/VelodyneScan", kBegin, velodyne_message(wire)}};
}

void check_recording(Bytes input, OpenRecording open) {
  const auto once = [&] { return run(input, open); };
  require(bounded(input, once) == bounded(input, once));
}

std::vector<testing::TestMessage> seed_messages(io::Wire wire) {
  auto messages = testing::cloud_messages(3, wire);
  const Pose pose{{}, {1, 2, 3}};
  messages.push_back(
      {"/tf", "tf2_msgs/msg/TFMessage", kBegin,
       testing::tf_message({{kBegin, "odom", "base", pose}, {kBegin, "base", "lidar", pose}}, wire)});
  messages.push_back({"/tf_static", "tf2_msgs/msg/TFMessage", kBegin,
                      testing::tf_message({{0, "base", "velodyne", pose}}, wire)});
  messages.push_back({"/odom", "nav_msgs/msg/Odometry", kBegin + 1,
                      testing::odometry_message({kBegin + 200'000'000, "odom", "lidar", pose}, wire)});
  testing::CloudParts bad = testing::simple_cloud(2);
  bad.fields[1].offset = 13;
  messages.push_back({"/points", "sensor_msgs/msg/PointCloud2", kBegin, testing::cloud_message(bad, wire)});
  return messages;
}

}  // namespace verge::fuzz
