// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/io/file/ros_messages.hpp"

#include <algorithm>
#include <array>

namespace verge::io {
namespace {

/// Types, and the MD5 sums of their ROS 1 definitions (docs/formats_ros.md says how they come about).
struct KnownType {
  std::string_view name;
  MessageKind kind;
  std::string_view md5;
};
constexpr std::array<KnownType, 5> kTypes{
    {{"sensor_msgs/PointCloud2", MessageKind::kPointCloud2, "1158d486dd51d683ce2f1be655c3c181"},
     {"velodyne_msgs/VelodyneScan", MessageKind::kVelodyneScan, "50804fc9533a0e579e6322c04ae70566"},
     {"tf2_msgs/TFMessage", MessageKind::kTransforms, "94810edda583a504dfda3829e70d7eec"},
     {"tf/tfMessage", MessageKind::kTransforms, "94810edda583a504dfda3829e70d7eec"},
     {"nav_msgs/Odometry", MessageKind::kOdometry, "cd5e73d190d741a2f92e81eda573aca7"}}};

const KnownType* find_type(std::string_view type) {
  constexpr std::string_view kMsg = "/msg/";
  std::string plain(type);
  if (const auto at = plain.find(kMsg); at != std::string::npos) plain.replace(at, kMsg.size(), "/");
  const auto* found =
      std::find_if(kTypes.begin(), kTypes.end(), [&](const KnownType& known) { return known.name == plain; });
  return found == kTypes.end() ? nullptr : found;
}

std::string frame_of(std::string_view text) {
  if (text.starts_with('/')) text.remove_prefix(1);
  return std::string(text);
}

Vec3 read_vector(MessageReader& reader) {
  const auto x = reader.number<double>();
  const auto y = reader.number<double>();
  const auto z = reader.number<double>();
  return {x, y, z};
}

/// geometry_msgs/Transform and geometry_msgs/Pose: translation, then quaternion x, y, z, w.
Pose read_pose(MessageReader& reader) {
  Pose pose;
  pose.translation = read_vector(reader);
  const Vec3 axis = read_vector(reader);
  pose.rotation = {reader.number<double>(), axis.x, axis.y, axis.z};
  return pose;
}

StampedTransform read_transform(MessageReader& reader) {
  RosHeader header = read_header(reader);
  StampedTransform out{header.stamp_ns, std::move(header.frame_id), frame_of(reader.text()), {}};
  out.T_parent_child = read_pose(reader);
  return out;
}

}  // namespace

MessageKind kind_of(std::string_view type) {
  const KnownType* known = find_type(type);
  return known == nullptr ? MessageKind::kOther : known->kind;
}

std::string_view md5_of(std::string_view type) {
  const KnownType* known = find_type(type);
  return known == nullptr ? std::string_view{} : known->md5;
}

RosHeader read_header(MessageReader& reader) {
  if (reader.wire() == Wire::kRos1) static_cast<void>(reader.number<std::uint32_t>());  // seq
  const std::int64_t stamp_ns = reader.time_ns();
  return {stamp_ns, frame_of(reader.text())};
}

void write_header(CdrWriter& writer, const RosHeader& header) {
  constexpr std::int64_t kNanoseconds = 1'000'000'000;
  std::int64_t seconds = header.stamp_ns / kNanoseconds;
  std::int64_t nanoseconds = header.stamp_ns % kNanoseconds;
  if (nanoseconds < 0) {
    nanoseconds += kNanoseconds;
    --seconds;
  }
  writer.number(static_cast<std::int32_t>(seconds));
  writer.number(static_cast<std::uint32_t>(nanoseconds));
  writer.text(header.frame_id);
}

Expected<std::vector<StampedTransform>> read_transforms(Wire wire, Bytes message) {
  constexpr std::size_t kLeastBytes = 8 + 4 + 4 + 7 * 8;  // stamp, two lengths, pose
  MessageReader reader(wire, message);
  std::vector<StampedTransform> out;
  for (std::uint32_t n = reader.count(kLeastBytes); n > 0 && !reader.fault(); --n) {
    out.push_back(read_transform(reader));
  }
  if (reader.fault()) return Unexpected(*reader.fault());
  return out;
}

Expected<StampedTransform> read_odometry(Wire wire, Bytes message) {
  MessageReader reader(wire, message);
  StampedTransform out = read_transform(reader);  // the covariance and the twist come behind
  if (reader.fault()) return Unexpected(*reader.fault());
  return out;
}

std::string write_transforms(const std::vector<StampedTransform>& transforms) {
  CdrWriter writer;
  writer.number(static_cast<std::uint32_t>(transforms.size()));
  for (const StampedTransform& transform : transforms) {
    write_header(writer, {transform.stamp_ns, transform.parent});
    writer.text(transform.child);
    const auto& [rotation, translation] = transform.T_parent_child;
    for (const double value :
         {translation.x, translation.y, translation.z, rotation.x, rotation.y, rotation.z, rotation.w}) {
      writer.number(value);
    }
  }
  return std::move(writer).take();
}

Expected<VelodyneScan> read_velodyne_scan(Wire wire, Bytes message) {
  constexpr std::size_t kPayload = 1206;
  MessageReader reader(wire, message);
  VelodyneScan out;
  out.header = read_header(reader);
  for (std::uint32_t n = reader.count(8 + kPayload); n > 0 && !reader.fault(); --n) {
    const std::int64_t received_ns = reader.time_ns();
    out.packets.push_back({received_ns, reader.bytes(kPayload)});
  }
  if (reader.fault()) return Unexpected(*reader.fault());
  return out;
}

}  // namespace verge::io
