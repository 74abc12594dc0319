// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "verge/core/bytes.hpp"
#include "verge/core/error.hpp"
#include "verge/core/pose.hpp"
#include "verge/io/file/ros_wire.hpp"

namespace verge::io {

/// What a message is for us, by its type.
enum class MessageKind : std::uint8_t { kPointCloud2, kVelodyneScan, kTransforms, kOdometry, kOther };

/// Of a type's name as ROS 1 ("sensor_msgs/PointCloud2") or ROS 2 ("sensor_msgs/msg/PointCloud2") writes it.
[[nodiscard]] MessageKind kind_of(std::string_view type);
[[nodiscard]] inline bool holds_scans(MessageKind kind) {
  return kind == MessageKind::kPointCloud2 || kind == MessageKind::kVelodyneScan;
}
[[nodiscard]] inline bool holds_poses(MessageKind kind) {
  return kind == MessageKind::kTransforms || kind == MessageKind::kOdometry;
}
/// The MD5 sum of the definition that we read, as ROS 1 computes it; empty for kOther. Another sum under the
/// same name means another layout.
[[nodiscard]] std::string_view md5_of(std::string_view type);

/// std_msgs/Header; the running number that ROS 1 has in it is left out.
struct RosHeader {
  std::int64_t stamp_ns = 0;  ///< 0: nobody filled it in.
  std::string frame_id;       ///< Without the leading '/' of old ROS 1.
};
[[nodiscard]] RosHeader read_header(MessageReader& reader);
void write_header(CdrWriter& writer, const RosHeader& header);

/// Pose of frame `child` in frame `parent` at a time.
struct StampedTransform {
  std::int64_t stamp_ns = 0;
  std::string parent;
  std::string child;
  Pose T_parent_child;
};

/// tf2_msgs/TFMessage (tf/tfMessage is the same).
[[nodiscard]] Expected<std::vector<StampedTransform>> read_transforms(Wire wire, Bytes message);
/// nav_msgs/Odometry: the pose of child_frame_id in header.frame_id.
[[nodiscard]] Expected<StampedTransform> read_odometry(Wire wire, Bytes message);
[[nodiscard]] std::string write_transforms(const std::vector<StampedTransform>& transforms);

/// One packet of a velodyne_msgs/VelodyneScan: the payload of 1206 bytes and when it was received.
struct VelodynePacket {
  std::int64_t received_ns = 0;
  Bytes payload;
};
struct VelodyneScan {
  RosHeader header;
  std::vector<VelodynePacket> packets;  ///< They look into the message.
};
[[nodiscard]] Expected<VelodyneScan> read_velodyne_scan(Wire wire, Bytes message);

}  // namespace verge::io
