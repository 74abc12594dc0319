// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <string>

#include "verge/core/pose.hpp"
#include "verge/io/file/ros_messages.hpp"

namespace verge::io {

/// Where a transform came from. Of two that place the same frame, the transform tree wins over odometry.
enum class TransformOrigin : std::uint8_t { kOdometry, kTree, kStatic };

/// The poses of frames in each other over the last seconds of a recording: every frame stands in one parent
/// frame. Memory is bounded: of each frame the last 10 s, at most 4096 poses, of at most 256 frames.
class Transforms {
 public:
  /// False where it cannot be used: not finite, no rotation, a frame without a name or in itself, one frame
  /// too many, or odometry of a frame that the tree places.
  [[nodiscard]] bool add(StampedTransform transform, TransformOrigin origin);

  /// Pose of the frame at `stamp_ns` in the world: the frame that stands in no other. Interpolated between
  /// the poses around that time; none where some frame on the way has none within 1 s around it, or where all
  /// of them are static (a frame that never moves in the world is not known to stand in it).
  [[nodiscard]] std::optional<Pose> T_world_frame(const std::string& frame, std::int64_t stamp_ns) const;

 private:
  struct Edge {
    std::string parent;
    TransformOrigin origin = TransformOrigin::kTree;
    std::deque<std::pair<std::int64_t, Pose>> poses;  // by time
  };
  static void insert(Edge& edge, std::int64_t stamp_ns, const Pose& pose);
  [[nodiscard]] static std::optional<Pose> pose_at(const Edge& edge, std::int64_t stamp_ns);

  std::map<std::string, Edge> edges_;  // by child
};

}  // namespace verge::io
