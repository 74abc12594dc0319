// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0

// ROS 1 bags against rosbag_storage, the library that ROS itself uses: bags that it writes are read by us.
// Built where Debian's librosbag-storage-dev and pluginlib-dev are installed.
#include <filesystem>
#include <string>
#include <vector>

#include <boost/make_shared.hpp>
#include <fmt/core.h>
#include <gtest/gtest.h>
#include <rosbag/bag.h>
#include <rosbag/view.h>
#include <unistd.h>

#include "verge/io/file/rosbag1.hpp"
#include "verge/io/file/test_bags.hpp"

/// A message that is bytes already, of the type sensor_msgs/PointCloud2.
struct RawCloud {
  std::string bytes;
};

namespace ros::message_traits {
template <>
struct MD5Sum<RawCloud> {
  static const char* value() { return "1158d486dd51d683ce2f1be655c3c181"; }
  static const char* value(const RawCloud&) { return value(); }
};
template <>
struct DataType<RawCloud> {
  static const char* value() { return "sensor_msgs/PointCloud2"; }
  static const char* value(const RawCloud&) { return value(); }
};
template <>
struct Definition<RawCloud> {
  static const char* value() { return "..."; }
  static const char* value(const RawCloud&) { return value(); }
};
}  // namespace ros::message_traits

namespace ros::serialization {
template <>
struct Serializer<RawCloud> {
  template <class Stream>
  static void write(Stream& stream, const RawCloud& cloud) {
    std::memcpy(stream.advance(static_cast<std::uint32_t>(cloud.bytes.size())), cloud.bytes.data(),
                cloud.bytes.size());
  }
  static std::uint32_t serializedLength(const RawCloud& cloud) {
    return static_cast<std::uint32_t>(cloud.bytes.size());
  }
};
}  // namespace ros::serialization

namespace verge::io {
namespace {

namespace fs = std::filesystem;

class RosbagStorage : public ::testing::TestWithParam<rosbag::CompressionType> {
 protected:
  void TearDown() override { fs::remove(file_); }
  fs::path file_ = fs::temp_directory_path() / fmt::format("verge-interop-{}.bag", ::getpid());
};

INSTANTIATE_TEST_SUITE_P(Compression, RosbagStorage,
                         ::testing::Values(rosbag::compression::Uncompressed, rosbag::compression::BZ2,
                                           rosbag::compression::LZ4));

}  // namespace

TEST_P(RosbagStorage, WritesWhatWeRead) {
  const auto messages = testing::cloud_messages(50, Wire::kRos1, 1000);
  {
    rosbag::Bag bag(file_.string(), rosbag::bagmode::Write);
    bag.setCompression(GetParam());
    bag.setChunkThreshold(100'000);
    for (const auto& message : messages) {
      ros::Time time;
      time.fromNSec(static_cast<std::uint64_t>(message.time_ns));
      bag.write("/points", time, RawCloud{message.data});
    }
  }
  auto input = Input::open(file_, {});
  ASSERT_TRUE(input);
  auto bag = open_rosbag1_bag(*std::move(input));
  ASSERT_TRUE(bag) << to_string(bag.error());
  for (const auto& message : messages) {
    const auto read = (*bag)->next();
    ASSERT_TRUE(read && *read);
    EXPECT_EQ((*read)->received_ns, message.time_ns);
    const Bytes data = (*read)->data;
    EXPECT_EQ(std::string(reinterpret_cast<const char*>(data.data()), data.size()), message.data);
  }
  const auto end = (*bag)->next();
  EXPECT_TRUE(end && !*end);
}

}  // namespace verge::io
