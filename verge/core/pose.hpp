// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>

#include "verge/core/vec.hpp"

namespace verge {

/// Unit quaternion (w, x, y, z).
struct Quaternion {
  double w = 1.0;
  double x = 0.0;
  double y = 0.0;
  double z = 0.0;

  friend bool operator==(const Quaternion&, const Quaternion&) = default;
};

/// Rigid transform. Named T_a_b at every use: it takes coordinates in frame b to frame a, p_a = T_a_b * p_b.
struct Pose {
  Quaternion rotation;
  Vec3 translation;

  friend bool operator==(const Pose&, const Pose&) = default;
};

[[nodiscard]] Vec3 rotate(const Quaternion& q, Vec3 p);
[[nodiscard]] Vec3 operator*(const Pose& T_a_b, Vec3 p_b);
/// T_a_c = T_a_b * T_b_c.
[[nodiscard]] Pose operator*(const Pose& T_a_b, const Pose& T_b_c);
/// T_b_a of T_a_b.
[[nodiscard]] Pose inverse(const Pose& T_a_b);

/// The pose a share `t` of the way from `a` (t = 0) to `b` (t = 1): translation linear, rotation along the
/// great arc. t outside [0, 1] extrapolates.
[[nodiscard]] Pose interpolate(const Pose& a, const Pose& b, double t);

/// Rotation about z by yaw, then y by pitch, then x by roll, radians (R = Rz Ry Rx; positive pitch = nose
/// down, REP 103).
[[nodiscard]] Quaternion from_yaw_pitch_roll(double yaw_rad, double pitch_rad, double roll_rad);
/// Yaw of a rotation, radians in [-pi, pi].
[[nodiscard]] double yaw_of(const Quaternion& q);

/// Pose of a row-major 3 x 4 matrix [R | t], as KITTI writes it. None where R is not a rotation to within
/// 1e-3.
[[nodiscard]] std::optional<Pose> pose_from_matrix(const std::array<double, 12>& row_major);

}  // namespace verge
