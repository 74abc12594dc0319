// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0

// What holds for a recording of ROS in any of the three formats; reliability B3, R.
#include "verge/io/file/bag.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <ostream>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "verge/io/file/mcap.hpp"
#include "verge/io/file/rosbag1.hpp"
#include "verge/io/file/rosbag2.hpp"
#include "verge/io/file/test_bags.hpp"
#include "verge/io/test_files.hpp"

namespace verge::io {
namespace {

using testing::bytes_of;
using testing::cloud_message;
using testing::cloud_messages;
using testing::CloudParts;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using testing::le;
using testing::odometry_message;
using testing::Outcome;
using testing::read_through;
using testing::simple_cloud;
using testing::TestMessage;
using testing::tf_message;

constexpr std::int64_t kBegin = 1'700'000'000'000'000'000;
constexpr std::int64_t kStep = 100'000'000;

/// One of the formats, chunked and packed one way.
struct FormatCase {
  std::string name;
  Wire wire;
  std::string (*make)(const std::vector<TestMessage>&);
  Expected<std::unique_ptr<Recording>> (*open)(Input, const RecordingOptions&);
};

std::ostream& operator<<(std::ostream& out, const FormatCase& format) { return out << format.name; }

const std::vector<FormatCase>& formats() {
  static const std::vector<FormatCase> kFormats{
      {"mcap_zstd", Wire::kCdr, [](const auto& m) { return testing::mcap_of(m); }, open_mcap},
      {"mcap_lz4_without_summary", Wire::kCdr,
       [](const auto& m) { return testing::mcap_of(m, {.packing = Packing::kLz4, .summary = false}); },
       open_mcap},
      {"mcap_none_without_checksums", Wire::kCdr,
       [](const auto& m) { return testing::mcap_of(m, {.packing = Packing::kNone, .checksums = false}); },
       open_mcap},
      {"mcap_without_chunks", Wire::kCdr,
       [](const auto& m) { return testing::mcap_of(m, {.messages_per_chunk = 0}); }, open_mcap},
      {"mcap_of_ros1", Wire::kRos1, [](const auto& m) { return testing::mcap_of(m, {.encoding = "ros1"}); },
       open_mcap},
      {"bag_none", Wire::kRos1, [](const auto& m) { return testing::rosbag1_of(m); }, open_rosbag1},
      {"bag_lz4", Wire::kRos1, [](const auto& m) { return testing::rosbag1_of(m, {.compression = "lz4"}); },
       open_rosbag1},
      {"bag_bz2", Wire::kRos1, [](const auto& m) { return testing::rosbag1_of(m, {.compression = "bz2"}); },
       open_rosbag1},
      {"db3", Wire::kCdr, [](const auto& m) { return testing::db3_of(m); }, open_db3},
      {"db3_zstd", Wire::kCdr, [](const auto& m) { return testing::db3_of(m, {.compress = true}); },
       open_db3}};
  return kFormats;
}

Outcome run_bytes(const FormatCase& format, const std::string& bytes, const RecordingOptions& options = {}) {
  return read_through(format.open(Input::of(bytes_of(bytes), "a.bag"), options));
}

void expect_sums(const std::map<std::string, std::uint64_t>& c) {
  EXPECT_EQ(c.at("messages received"), c.at("messages of scans") + c.at("messages of poses") +
                                           c.at("messages of other topics") + c.at("messages rejected"));
  for (const std::string kind : {"records", "chunks", "rows", "transforms"}) {
    if (!c.contains(kind + " received")) continue;
    EXPECT_EQ(c.at(kind + " received"), c.at(kind + " used") + c.at(kind + " rejected")) << kind;
  }
}

TestMessage cloud_at(std::int64_t time_ns, std::uint32_t points, Wire wire,
                     const std::string& topic = "/points") {
  return {topic, "sensor_msgs/msg/PointCloud2", time_ns, cloud_message(simple_cloud(points, time_ns), wire)};
}

class Bags : public ::testing::TestWithParam<FormatCase> {};

INSTANTIATE_TEST_SUITE_P(AllFormats, Bags, ::testing::ValuesIn(formats()),
                         [](const auto& test) { return test.param.name; });

TEST_P(Bags, GiveTheirScansInOrder) {
  const FormatCase& format = GetParam();
  auto messages = cloud_messages(7, format.wire);
  messages.insert(messages.begin() + 2, {"/chatter", "std_msgs/msg/String", kBegin, "whatever"});
  const Outcome got = run_bytes(format, format.make(messages));
  ASSERT_EQ(got.errors.size(), 0U) << to_string(got.errors.front());
  ASSERT_EQ(got.scans.size(), 7U);
  for (std::size_t i = 0; i < 7; ++i) {
    EXPECT_EQ(got.scans[i].cloud.x.size(), i + 1);
    EXPECT_EQ(got.scans[i].cloud.x.back(), static_cast<float>(i + 1));
    EXPECT_EQ(got.scans[i].stamp_ns, kBegin + static_cast<std::int64_t>(i) * kStep);
    EXPECT_EQ(got.scans[i].frame_id, "lidar");
  }
  EXPECT_EQ(got.counters.at("messages received"), 8U);
  EXPECT_EQ(got.counters.at("messages of scans"), 7U);
  EXPECT_EQ(got.counters.at("messages of other topics"), 1U);
  expect_sums(got.counters);
}

TEST_P(Bags, CutAtEveryByteTheyNeverGiveAnotherScan) {
  const FormatCase& format = GetParam();
  const std::string whole = format.make(cloud_messages(3, format.wire));
  const Outcome all = run_bytes(format, whole);
  const std::size_t step = std::max<std::size_t>(1, whole.size() / 2000);
  for (std::size_t n = 0; n < whole.size(); n += step) {
    const std::string cut = whole.substr(0, n);
    auto recording = format.open(Input::of(bytes_of(cut), "a.bag"), {});
    if (!recording) continue;
    const Outcome got = read_through(std::move(recording));
    EXPECT_LT(got.errors.size(), 1000U);
    EXPECT_GE(got.errors.size(), got.scans.size() < 3 ? 1U : 0U) << n;
    ASSERT_LE(got.scans.size(), 3U);
    for (std::size_t i = 0; i < got.scans.size(); ++i)
      EXPECT_EQ(got.scans[i].cloud.x, all.scans[i].cloud.x) << n;
    expect_sums(got.counters);
  }
}

TEST_P(Bags, SeveralTopicsWithScansHaveToBeChosenFrom) {
  const FormatCase& format = GetParam();
  auto messages = cloud_messages(3, format.wire);
  messages.push_back(cloud_at(kBegin, 9, format.wire, "/rear/points"));
  const std::string bytes = format.make(messages);
  const auto none = format.open(Input::of(bytes_of(bytes), "a.bag"), {});
  ASSERT_FALSE(none);
  EXPECT_EQ(none.error().code, ErrorCode::kUsage);
  EXPECT_THAT(none.error().what, HasSubstr("choose --topic"));
  EXPECT_THAT(none.error().got, HasSubstr("/points (sensor_msgs"));
  EXPECT_THAT(none.error().got, HasSubstr("/rear/points (sensor_msgs"));
  for (const std::string name : {"/rear/points", "rear/points"}) {
    const Outcome got = run_bytes(format, bytes, {.topic = name});
    ASSERT_EQ(got.scans.size(), 1U);
    EXPECT_EQ(got.scans.front().cloud.x.size(), 9U);
    EXPECT_EQ(got.counters.at("messages of other topics"), 3U);
    expect_sums(got.counters);
  }
  const auto wrong = format.open(Input::of(bytes_of(bytes), "a.bag"), {.topic = "/front"});
  ASSERT_FALSE(wrong);
  EXPECT_EQ(wrong.error().code, ErrorCode::kUsage);
  EXPECT_THAT(wrong.error().need, HasSubstr("/rear/points"));
}

TEST_P(Bags, WithoutScansSayWhatTheyHave) {
  const FormatCase& format = GetParam();
  const std::string bytes = format.make({{"/chatter", "std_msgs/msg/String", kBegin, "whatever"}});
  const auto bag = format.open(Input::of(bytes_of(bytes), "a.bag"), {});
  ASSERT_FALSE(bag);
  EXPECT_EQ(bag.error().code, ErrorCode::kUnusable);
  EXPECT_THAT(bag.error().got, HasSubstr("/chatter (std_msgs/"));
}

TEST_P(Bags, PosesOfTheTreeGiveMotion) {
  const FormatCase& format = GetParam();
  // The car drives 10 m/s along x from t = 0 on; the sensor is 2 m above it. Poses every 30 ms from 50 ms
  // after the scan to which they belong: scans have to wait for them.
  std::vector<TestMessage> messages;
  const auto pose_at = [](std::int64_t t) {
    return Pose{{}, {1e-8 * static_cast<double>(t - kBegin), 0, 0}};
  };
  messages.push_back({"/tf_static", "tf2_msgs/msg/TFMessage", kBegin,
                      tf_message({{0, "base", "lidar", {{}, {0, 0, 2}}}}, format.wire)});
  for (int i = 0; i < 40; ++i) {
    const std::int64_t t = kBegin + i * 30'000'000LL;
    messages.push_back({"/tf", "tf2_msgs/msg/TFMessage", t + 50'000'000,
                        tf_message({{t, "odom", "base", pose_at(t)}}, format.wire)});
  }
  for (int i = 0; i < 10; ++i) {
    const std::int64_t t = kBegin + i * kStep;
    CloudParts parts = simple_cloud(2, t);
    parts.fields.push_back({"t", 14, 6, 1});
    parts.point_step = 18;
    parts.row_step = 36;
    parts.data = simple_cloud(1).data + le(0U) + simple_cloud(1).data + le(90'000'000U);
    messages.push_back({"/points", "sensor_msgs/msg/PointCloud2", t + 1, cloud_message(parts, format.wire)});
  }
  std::stable_sort(messages.begin(), messages.end(),
                   [](const auto& a, const auto& b) { return a.time_ns < b.time_ns; });
  const Outcome got = run_bytes(format, format.make(messages));
  ASSERT_EQ(got.errors.size(), 0U) << to_string(got.errors.front());
  ASSERT_EQ(got.scans.size(), 10U);
  for (std::size_t i = 0; i < 10; ++i) {
    const Decoded& scan = got.scans[i];
    ASSERT_TRUE(scan.T_world_sensor && scan.motion) << i;
    EXPECT_NEAR(scan.T_world_sensor->translation.x, static_cast<double>(i), 1e-9);
    EXPECT_NEAR(scan.T_world_sensor->translation.z, 2.0, 1e-12);
    EXPECT_EQ(scan.motion->duration_ns, 90'000'000);
    EXPECT_NEAR(scan.motion->T_world_sensor_end.translation.x, static_cast<double>(i) + 0.9, 1e-9);
  }
  expect_sums(got.counters);
  EXPECT_EQ(got.counters.at("transforms used"), 41U);
}

TEST_P(Bags, OdometryOfTheSensorsFrameGivesItsPose) {
  const FormatCase& format = GetParam();
  std::vector<TestMessage> messages;
  for (int i = 0; i < 4; ++i) {
    const std::int64_t t = kBegin + i * kStep;
    messages.push_back({"/odom", "nav_msgs/msg/Odometry", t,
                        odometry_message({t, "odom", "lidar", {{}, {0.5 * i, 0, 0}}}, format.wire)});
    messages.push_back(cloud_at(t, 3, format.wire));
  }
  const Outcome got = run_bytes(format, format.make(messages));
  ASSERT_EQ(got.scans.size(), 4U);
  for (std::size_t i = 0; i < 4; ++i) {
    ASSERT_TRUE(got.scans[i].T_world_sensor);
    EXPECT_EQ(got.scans[i].T_world_sensor->translation.x, 0.5 * static_cast<double>(i));
    EXPECT_FALSE(got.scans[i].motion);  // the points have no times
  }
}

/// Four messages of 76 packets each of a VLP-16 at 10 Hz that sees a wall around it at 10 m (0.4 degrees a
/// block); packets of whose number `product` says so are of another model.
std::vector<TestMessage> vlp16_messages(Wire wire, const std::function<char(int)>& product) {
  std::vector<TestMessage> messages;
  int azimuth = 18000;
  std::uint32_t microseconds = 0;
  for (int m = 0; m < 4; ++m) {
    const std::int64_t begin = kBegin + m * kStep;
    testing::WireWriter scan(wire);
    scan.header(begin, "velodyne").number(std::uint32_t{76});
    for (int p = 0; p < 76; ++p) {
      std::string payload;
      for (int block = 0; block < 12; ++block) {
        payload += "\xFF\xEE" + le(static_cast<std::uint16_t>(azimuth));
        for (int i = 0; i < 32; ++i) payload += le(std::uint16_t{5000}) + "\x20";
        azimuth = (azimuth + 40) % 36000;
      }
      payload += le(microseconds) + "\x37" + product(76 * m + p);
      scan.number(static_cast<std::uint32_t>(begin / 1'000'000'000));
      scan.number(static_cast<std::uint32_t>(begin % 1'000'000'000 + p * 1'327'000)).raw(payload);
      microseconds += 1327;
    }
    messages.push_back({"/velodyne_packets", "velodyne_msgs/msg/VelodyneScan", begin + kStep, scan.bytes()});
  }
  return messages;
}

constexpr char kVlp16 = '\x22';
constexpr char kHdl32e = '\x21';

TEST_P(Bags, PacketsOfAVelodyneGiveRevolutions) {
  const FormatCase& format = GetParam();
  const auto messages = vlp16_messages(format.wire, [](int) { return kVlp16; });
  const Outcome got = read_through(format.open(Input::of(bytes_of(format.make(messages)), "a.bag"), {}));
  ASSERT_EQ(got.errors.size(), 0U) << to_string(got.errors.front());
  ASSERT_GE(got.scans.size(), 4U);
  for (const Decoded& scan : got.scans) {
    EXPECT_EQ(scan.frame_id, "velodyne");
    for (std::size_t i = 0; i < scan.cloud.x.size(); ++i) {
      ASSERT_NEAR(std::hypot(scan.cloud.x[i], scan.cloud.y[i], scan.cloud.z[i]), 10.0, 1e-3);
    }
  }
  EXPECT_NEAR(static_cast<double>(got.scans[1].cloud.x.size()), 900 * 32, 64);
  EXPECT_EQ(got.counters.at("packets received"), 4U * 76U);
  EXPECT_EQ(got.counters.at("packets used"), 4U * 76U);
  EXPECT_EQ(got.counters.at("messages of scans"), 4U);
  expect_sums(got.counters);
  const auto wrong = format.open(Input::of(bytes_of(format.make(messages)), "a.bag"), {.model = "lux"});
  ASSERT_FALSE(wrong);
  EXPECT_EQ(wrong.error().code, ErrorCode::kUsage);
}

TEST_P(Bags, ACalibrationIsOfTheModelThatTheFirstMessageShows) {
  const FormatCase& format = GetParam();
  const testing::TemporaryFolder folder;
  std::string text = "lasers:\n";
  for (int i = 0; i < 16; ++i) {
    text += "- {laser_id: " + std::to_string(i) + ", vert_correction: " + std::to_string(0.01 * i) +
            ", dist_correction: 1.0}\n";
  }
  // The very first packet is damaged.
  const auto messages =
      vlp16_messages(format.wire, [](int packet) { return packet == 0 ? kHdl32e : kVlp16; });
  const std::string bytes = format.make(messages);
  RecordingOptions options;
  options.calibration = folder.write("16.yaml", text);
  const Outcome got = read_through(format.open(Input::of(bytes_of(bytes), "a.bag"), options));
  ASSERT_GE(got.scans.size(), 4U);
  const auto& cloud = got.scans[0].cloud;
  EXPECT_NEAR(std::hypot(cloud.x[0], cloud.y[0], cloud.z[0]), 11.0, 1e-3);
  options.calibration = folder.write("15.yaml", text.substr(0, text.rfind("- {")));
  const auto wrong = format.open(Input::of(bytes_of(bytes), "a.bag"), options);
  ASSERT_FALSE(wrong);
  EXPECT_EQ(wrong.error().code, ErrorCode::kUsage);
  EXPECT_THAT(to_string(wrong.error()), HasSubstr("got 15 lasers, need 16 lasers"));
}

TEST_P(Bags, PacketsOfAnotherModelAreDamage) {
  const FormatCase& format = GetParam();
  const auto read = [&](const std::function<char(int)>& product) {
    const std::string bytes = format.make(vlp16_messages(format.wire, product));
    return read_through(format.open(Input::of(bytes_of(bytes), "a.bag"), {}));
  };
  const Outcome some = read([](int packet) { return packet >= 150 && packet < 160 ? kHdl32e : kVlp16; });
  ASSERT_EQ(some.errors.size(), 1U);
  EXPECT_EQ(some.errors[0].code, ErrorCode::kDamaged);
  EXPECT_THAT(to_string(some.errors[0]), HasSubstr("left out (got 10 of 304 packets, need vlp16)"));
  EXPECT_FALSE(some.errors[0].where.empty());
  EXPECT_GE(some.scans.size(), 4U);
  const Outcome none = read([](int) { return '\x7F'; });
  ASSERT_EQ(none.errors.size(), 1U);
  EXPECT_EQ(none.errors[0].code, ErrorCode::kUnusable);
  EXPECT_THAT(to_string(none.errors[0]), HasSubstr("304 of 304 packets are of another model"));
}

TEST_P(Bags, ScansWithoutPosesDoNotWaitForThemForEver) {
  const FormatCase& format = GetParam();
  auto messages = cloud_messages(30, format.wire);
  messages.insert(messages.begin(), {"/tf", "tf2_msgs/msg/TFMessage", kBegin,
                                     tf_message({{kBegin, "odom", "elsewhere", {}}}, format.wire)});
  const Outcome got = run_bytes(format, format.make(messages));
  ASSERT_EQ(got.scans.size(), 30U);
  for (std::size_t i = 0; i < 30; ++i) EXPECT_EQ(got.scans[i].cloud.x.size(), i + 1);
}

TEST_P(Bags, R6ADamagedCloudIsAnErrorAndTheNextIsRead) {
  const FormatCase& format = GetParam();
  auto messages = cloud_messages(5, format.wire);
  CloudParts parts = simple_cloud(3);
  parts.point_step = 0;
  messages[1].data = cloud_message(parts, format.wire);
  parts = simple_cloud(3);
  parts.fields[2].offset = 11;
  messages[3].data = cloud_message(parts, format.wire);
  const Outcome got = run_bytes(format, format.make(messages));
  EXPECT_EQ(got.scans.size(), 3U);
  ASSERT_EQ(got.errors.size(), 2U);
  EXPECT_EQ(got.errors[0].code, ErrorCode::kDamaged);
  EXPECT_EQ(got.errors[0].file, "a.bag");
  EXPECT_FALSE(got.errors[0].where.empty());
  EXPECT_EQ(got.counters.at("messages rejected"), 2U);
  expect_sums(got.counters);
}

TEST_P(Bags, R9TimeThatGoesBackIsSaid) {
  const FormatCase& format = GetParam();
  auto messages = cloud_messages(3, format.wire);
  messages.push_back(cloud_at(kBegin - 3'600'000'000'000, 5, format.wire));
  messages.push_back(cloud_at(kBegin - 3'599'900'000'000, 6, format.wire));
  const Outcome got = run_bytes(format, format.make(messages));
  ASSERT_EQ(got.scans.size(), 5U);
  EXPECT_THAT(got.scans[3].notes, ElementsAre(HasSubstr("goes back in time")));
  EXPECT_TRUE(got.scans[4].notes.empty());
}

TEST_P(Bags, AreTheSameEveryTime) {
  const FormatCase& format = GetParam();
  const std::string bytes = format.make(cloud_messages(4, format.wire));
  const Outcome first = run_bytes(format, bytes);
  const Outcome second = run_bytes(format, bytes);
  EXPECT_EQ(first.counters, second.counters);
  ASSERT_EQ(first.scans.size(), second.scans.size());
  for (std::size_t i = 0; i < first.scans.size(); ++i)
    EXPECT_EQ(first.scans[i].cloud.x, second.scans[i].cloud.x);
}

TEST_P(Bags, AnyByteMayBeWrong) {
  const FormatCase& format = GetParam();
  const std::string whole = format.make(cloud_messages(2, format.wire));
  const std::size_t step = std::max<std::size_t>(1, whole.size() / 1500);
  for (std::size_t i = 0; i < whole.size(); i += step) {
    for (const int value : {0x00, 0x7F, 0xFF}) {
      std::string bad = whole;
      bad[i] = static_cast<char>(value);
      auto recording = format.open(Input::of(bytes_of(bad), "a.bag"), {});
      if (!recording) continue;
      const Outcome got = read_through(std::move(recording));
      EXPECT_LT(got.errors.size(), 1000U);
      expect_sums(got.counters);
    }
  }
}

}  // namespace
}  // namespace verge::io
