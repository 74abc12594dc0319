// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/io/file/transforms.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace verge::io {
namespace {

constexpr std::int64_t kSecond_ns = 1'000'000'000;
constexpr std::uint64_t kKept_ns = 10 * kSecond_ns;
constexpr std::int64_t kWidestGap_ns = kSecond_ns;
constexpr std::size_t kMostPoses = 4096;
constexpr std::size_t kMostFrames = 256;

/// How far apart two times are; unsigned, since two stamps may lie farther apart than 2^63 ns.
std::uint64_t distance(std::int64_t a, std::int64_t b) {
  const auto [low, high] = std::minmax(a, b);
  return static_cast<std::uint64_t>(high) - static_cast<std::uint64_t>(low);
}

bool is_finite(const Vec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

/// The rotation with a length of 1; none where it is no rotation. One that is right already stays bit for
/// bit.
std::optional<Quaternion> unit(const Quaternion& q) {
  constexpr double kAsWritten = 1e-9;  // what rounding makes of a unit quaternion
  constexpr double kTolerance = 0.01;
  const double length = std::sqrt(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z);
  if (!(std::fabs(length - 1.0) <= kTolerance)) return std::nullopt;  // NaN too
  if (std::fabs(length - 1.0) <= kAsWritten) return q;
  return Quaternion{q.w / length, q.x / length, q.y / length, q.z / length};
}

}  // namespace

void Transforms::insert(Edge& edge, std::int64_t stamp_ns, const Pose& pose) {
  auto& poses = edge.poses;
  if (edge.origin == TransformOrigin::kStatic) poses.clear();
  // A recording that jumps in time (a loop, a clock that was set) begins anew.
  if (!poses.empty() && distance(poses.back().first, stamp_ns) > kKept_ns) poses.clear();
  const auto place =
      std::lower_bound(poses.begin(), poses.end(), stamp_ns,
                       [](const auto& entry, std::int64_t time) { return entry.first < time; });
  if (place != poses.end() && place->first == stamp_ns) {
    place->second = pose;
  } else {
    poses.insert(place, {stamp_ns, pose});
  }
  while (poses.size() > kMostPoses || distance(poses.front().first, poses.back().first) > kKept_ns) {
    poses.pop_front();
  }
}

bool Transforms::add(StampedTransform transform, TransformOrigin origin) {
  const auto rotation = unit(transform.T_parent_child.rotation);
  if (!rotation || !is_finite(transform.T_parent_child.translation)) return false;
  if (transform.child.empty() || transform.parent.empty() || transform.child == transform.parent)
    return false;
  const auto found = edges_.find(transform.child);
  if (found == edges_.end() && edges_.size() == kMostFrames) return false;
  Edge& edge = found == edges_.end() ? edges_[transform.child] : found->second;
  const bool is_known = !edge.parent.empty();
  if (is_known && origin == TransformOrigin::kOdometry && edge.origin != origin) return false;
  if (!is_known || edge.parent != transform.parent || edge.origin != origin) {
    edge = {std::move(transform.parent), origin, {}};
  }
  insert(edge, transform.stamp_ns, {*rotation, transform.T_parent_child.translation});
  return true;
}

std::optional<Pose> Transforms::pose_at(const Edge& edge, std::int64_t stamp_ns) {
  const auto& poses = edge.poses;
  if (edge.origin == TransformOrigin::kStatic) return poses.front().second;
  const auto after =
      std::lower_bound(poses.begin(), poses.end(), stamp_ns,
                       [](const auto& entry, std::int64_t time) { return entry.first < time; });
  if (after == poses.end()) return std::nullopt;
  if (after->first == stamp_ns) return after->second;
  if (after == poses.begin()) return std::nullopt;
  const auto before = std::prev(after);
  const std::int64_t gap = after->first - before->first;  // at most kKept_ns
  if (gap > kWidestGap_ns) return std::nullopt;
  const double share = static_cast<double>(stamp_ns - before->first) / static_cast<double>(gap);
  return interpolate(before->second, after->second, share);
}

std::optional<Pose> Transforms::T_world_frame(const std::string& frame, std::int64_t stamp_ns) const {
  std::optional<Pose> out;
  bool moves = false;
  auto at = edges_.find(frame);
  for (std::size_t steps = 0; at != edges_.end(); ++steps) {
    if (steps == kMostFrames) return std::nullopt;  // frames that stand in each other
    const auto pose = pose_at(at->second, stamp_ns);
    if (!pose) return std::nullopt;
    out = out ? *pose * *out : *pose;
    moves = moves || at->second.origin != TransformOrigin::kStatic;
    at = edges_.find(at->second.parent);
  }
  return moves ? out : std::nullopt;
}

}  // namespace verge::io
