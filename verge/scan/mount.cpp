// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/scan/mount.hpp"

#include <cmath>

#include "verge/scan/road_heading.hpp"
#include "verge/scan/road_plane.hpp"
#include "verge/scan/scan.hpp"

namespace verge {
namespace {

/// Rows of Rz(-forward) Ry(pitch) Rx(roll).
std::array<Vec3, 3> rotation_rows(const Mount& mount) {
  const double cp = std::cos(mount.pitch_rad);
  const double sp = std::sin(mount.pitch_rad);
  const double cr = std::cos(mount.roll_rad);
  const double sr = std::sin(mount.roll_rad);
  const double cf = std::cos(mount.forward_rad);
  const double sf = std::sin(mount.forward_rad);
  const Vec3 ahead{cp, sp * sr, sp * cr};
  const Vec3 aside{0.0, cr, -sr};
  return {cf * ahead + sf * aside, cf * aside - sf * ahead, {-sp, cp * sr, cp * cr}};
}

Mount mount_of(const RoadPlane& plane) {
  const double length = std::hypot(1.0, std::hypot(plane.slope_x, plane.slope_y));
  const Vec3 up{-plane.slope_x / length, -plane.slope_y / length, 1.0 / length};
  return {-plane.offset / length, -std::asin(up.x), std::atan2(up.y, up.z), 0.0};
}

}  // namespace

LevelFrame::LevelFrame(const Mount& mount) : rows_(rotation_rows(mount)), height_m_(mount.height_m) {}

Vec3 LevelFrame::to_sensor(Vec3 p_level) const {
  return p_level.x * rows_[0] + p_level.y * rows_[1] + (p_level.z - height_m_) * rows_[2];
}

MountEstimate estimate_mount(const Scan& scan, const MountHint& hint, const MountConfig& config) {
  MountEstimate estimate;
  const auto first = find_road_plane(scan, hint, config);
  std::optional<double> heading = hint.forward_rad;
  if (first) {
    RoadPlane plane = *first;
    // Twice: the first plane leans on the sensor's axes. What is found along the road from a plane that was
    // itself found along the road no longer depends on how the vehicle stands on it.
    for (int pass = 0; pass < 2; ++pass) {
      if (!hint.forward_rad) heading = find_road_heading(scan, mount_of(plane), config);
      plane = refine_along_road(scan, plane, heading.value_or(0.0), hint, config);
    }
    estimate.mount = mount_of(plane);
    estimate.inlier_share = first->inlier_share;
  }
  // What is known stands, to the last bit.
  estimate.mount.height_m = hint.height_m.value_or(estimate.mount.height_m);
  estimate.mount.pitch_rad = hint.pitch_rad.value_or(estimate.mount.pitch_rad);
  estimate.mount.roll_rad = hint.roll_rad.value_or(estimate.mount.roll_rad);
  estimate.mount.forward_rad = heading.value_or(0.0);
  estimate.plane_found = first.has_value();
  estimate.heading_found = heading.has_value() && !hint.forward_rad;
  return estimate;
}

}  // namespace verge
