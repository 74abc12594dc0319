// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <cstring>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "verge/core/pose.hpp"
#include "verge/io/file/packing.hpp"
#include "verge/io/file/ros_wire.hpp"
#include "verge/io/recording.hpp"

// Recordings of ROS for tests, made from the descriptions of the formats (docs/formats_ros.md) without any of
// the code that reads them.

namespace verge::testing {

/// Writes the values of a message, in any of the wires and byte orders.
class WireWriter {
 public:
  explicit WireWriter(io::Wire wire = io::Wire::kCdr, bool big_endian = false);

  template <class T>
  WireWriter& number(T value) {
    if (wire_ == io::Wire::kCdr) {
      while ((out_.size() - 4) % sizeof(T) != 0) out_.push_back('\0');
    }
    std::string raw(sizeof(T), '\0');
    std::memcpy(raw.data(), &value, sizeof(T));
    if (big_endian_) raw.assign(raw.rbegin(), raw.rend());
    out_ += raw;
    return *this;
  }
  WireWriter& text(std::string_view value);
  WireWriter& raw(std::string_view bytes);
  WireWriter& header(std::int64_t stamp_ns, std::string_view frame);
  [[nodiscard]] const std::string& bytes() const { return out_; }

 private:
  io::Wire wire_;
  bool big_endian_;
  std::string out_;
};

/// A field of a PointCloud2.
struct CloudField {
  std::string name;
  std::uint32_t offset = 0;
  std::uint8_t datatype = 7;
  std::uint32_t count = 1;
};

/// A PointCloud2 as its parts; what the parts say need not be true.
struct CloudParts {
  std::int64_t stamp_ns = 1'700'000'000'500'000'000;
  std::string frame = "lidar";
  std::uint32_t height = 1;
  std::uint32_t width = 0;
  std::vector<CloudField> fields;
  bool big_endian = false;
  std::uint32_t point_step = 0;
  std::uint32_t row_step = 0;
  std::string data;
};
[[nodiscard]] std::string cloud_message(const CloudParts& parts, io::Wire wire = io::Wire::kCdr,
                                        bool big_endian_wire = false);

/// A cloud of n points (i + 1, 2, 3), ring i % 4, float32 and uint16.
[[nodiscard]] CloudParts simple_cloud(std::uint32_t n, std::int64_t stamp_ns = 1'700'000'000'500'000'000);

struct TestTransform {
  std::int64_t stamp_ns = 0;
  std::string parent, child;
  Pose pose;
};
[[nodiscard]] std::string tf_message(const std::vector<TestTransform>& transforms,
                                     io::Wire wire = io::Wire::kCdr);
[[nodiscard]] std::string odometry_message(const TestTransform& transform, io::Wire wire = io::Wire::kCdr);

/// A message of a recording. `type` is written as ROS 2 does ("sensor_msgs/msg/PointCloud2").
struct TestMessage {
  std::string topic;
  std::string type;
  std::int64_t time_ns = 0;
  std::string data;
};

struct McapShape {
  io::Packing packing = io::Packing::kZstd;
  std::size_t messages_per_chunk = 2;  ///< 0: no chunks.
  bool summary = true;
  bool footer = true;  ///< false: the recorder was killed.
  bool checksums = true;
  std::string encoding = "cdr";
};
[[nodiscard]] std::string mcap_of(const std::vector<TestMessage>& messages, const McapShape& shape = {});
/// A record of MCAP.
[[nodiscard]] std::string mcap_record(std::uint8_t op, std::string_view content);

struct BagShape {
  std::string compression = "none";  ///< none, lz4, bz2
  std::size_t messages_per_chunk = 2;
  bool index = true;  ///< false: the bag was not closed.
  std::string md5{};  ///< Of all types; empty: the right ones.
};
/// A ROS 1 bag; the messages' data are of Wire::kRos1.
[[nodiscard]] std::string rosbag1_of(const std::vector<TestMessage>& messages, const BagShape& shape = {});
/// Records as a chunk of a ROS 1 bag with this compression holds them.
[[nodiscard]] std::string packed_by(const std::string& compression, std::string records);
/// A field of the header of a record of a ROS 1 bag, and a record.
[[nodiscard]] std::string bag_field(std::string_view name, std::string_view value);
[[nodiscard]] std::string bag_record(std::string_view header, std::string_view data);
template <class T>
[[nodiscard]] std::string le(T value) {
  std::string raw(sizeof(T), '\0');
  std::memcpy(raw.data(), &value, sizeof(T));
  return raw;
}

struct Db3Shape {
  bool compress = false;  ///< Each message with zstd.
  std::string serialization = "cdr";
  std::uint32_t page_bytes = 4096;
  std::string more_sql{};  ///< Run at the end.
};
[[nodiscard]] std::string db3_of(const std::vector<TestMessage>& messages, const Db3Shape& shape = {});

/// What a recording gave from beginning to end.
struct Outcome {
  std::vector<io::Decoded> scans;
  std::vector<Error> errors;  ///< Of opening too; at most 1000.
  std::map<std::string, std::uint64_t> counters;

  [[nodiscard]] std::vector<std::size_t> points() const;  ///< Of each scan.
};
[[nodiscard]] Outcome read_through(Expected<std::unique_ptr<io::Recording>> recording);

/// Clouds of first + 1, first + 2, ... points on /points, one each 0.1 s from 1.7e9 s on.
[[nodiscard]] std::vector<TestMessage> cloud_messages(std::uint32_t n, io::Wire wire = io::Wire::kCdr,
                                                      std::uint32_t first = 0);

}  // namespace verge::testing
