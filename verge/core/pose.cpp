// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/core/pose.hpp"

#include <algorithm>
#include <cmath>

namespace verge {
namespace {

double dot(const Quaternion& a, const Quaternion& b) { return a.w * b.w + a.x * b.x + a.y * b.y + a.z * b.z; }

Quaternion normalized(const Quaternion& q) {
  const double n = 1.0 / std::sqrt(dot(q, q));
  return {n * q.w, n * q.x, n * q.y, n * q.z};
}

Quaternion conjugate(const Quaternion& q) { return {q.w, -q.x, -q.y, -q.z}; }

Quaternion product(const Quaternion& a, const Quaternion& b) {
  return {a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z, a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y,
          a.w * b.y - a.x * b.z + a.y * b.w + a.z * b.x, a.w * b.z + a.x * b.y - a.y * b.x + a.z * b.w};
}

Quaternion blend(const Quaternion& a, const Quaternion& b, double share_a, double share_b) {
  return {share_a * a.w + share_b * b.w, share_a * a.x + share_b * b.x, share_a * a.y + share_b * b.y,
          share_a * a.z + share_b * b.z};
}

Quaternion slerp(const Quaternion& a, Quaternion b, double t) {
  double cosine = dot(a, b);
  if (cosine < 0.0) {  // q and -q are the same rotation: take the shorter way
    b = {-b.w, -b.x, -b.y, -b.z};
    cosine = -cosine;
  }
  constexpr double kNearlyEqual = 1.0 - 1e-12;
  if (cosine > kNearlyEqual) return normalized(blend(a, b, 1.0 - t, t));
  const double angle = std::acos(std::min(cosine, 1.0));
  return normalized(blend(a, b, std::sin((1.0 - t) * angle), std::sin(t * angle)));
}

}  // namespace

Vec3 rotate(const Quaternion& q, Vec3 p) {
  const Vec3 axis{q.x, q.y, q.z};
  const Vec3 t = 2.0 * cross(axis, p);
  return p + q.w * t + cross(axis, t);
}

Vec3 operator*(const Pose& T_a_b, Vec3 p_b) { return rotate(T_a_b.rotation, p_b) + T_a_b.translation; }

Pose operator*(const Pose& T_a_b, const Pose& T_b_c) {
  return {normalized(product(T_a_b.rotation, T_b_c.rotation)), T_a_b * T_b_c.translation};
}

Pose inverse(const Pose& T_a_b) {
  const Quaternion back = conjugate(T_a_b.rotation);
  return {back, -1.0 * rotate(back, T_a_b.translation)};
}

Pose interpolate(const Pose& a, const Pose& b, double t) {
  if (a == b) return a;  // to the last bit, which turning by nothing is not
  return {slerp(a.rotation, b.rotation, t), a.translation + t * (b.translation - a.translation)};
}

Quaternion from_yaw_pitch_roll(double yaw_rad, double pitch_rad, double roll_rad) {
  const Quaternion yaw{std::cos(yaw_rad / 2), 0.0, 0.0, std::sin(yaw_rad / 2)};
  const Quaternion pitch{std::cos(pitch_rad / 2), 0.0, std::sin(pitch_rad / 2), 0.0};
  const Quaternion roll{std::cos(roll_rad / 2), std::sin(roll_rad / 2), 0.0, 0.0};
  return normalized(product(product(yaw, pitch), roll));
}

double yaw_of(const Quaternion& q) {
  return std::atan2(2.0 * (q.w * q.z + q.x * q.y), 1.0 - 2.0 * (q.y * q.y + q.z * q.z));
}

std::optional<Pose> pose_from_matrix(const std::array<double, 12>& m) {
  const Vec3 rows[3] = {{m[0], m[1], m[2]}, {m[4], m[5], m[6]}, {m[8], m[9], m[10]}};
  constexpr double kTolerance = 1e-3;
  for (int i = 0; i < 3; ++i) {
    for (int j = i; j < 3; ++j) {
      const double off = verge::dot(rows[i], rows[j]) - (i == j ? 1.0 : 0.0);
      if (!(std::abs(off) < kTolerance)) return std::nullopt;
    }
  }
  if (verge::dot(cross(rows[0], rows[1]), rows[2]) < 0.0) return std::nullopt;  // a mirror, not a rotation

  // Shepperd's method: divide by the largest component, so that no case is badly conditioned.
  const double trace = m[0] + m[5] + m[10];
  Quaternion q;
  if (trace >= std::max({m[0], m[5], m[10]})) {
    q = {1.0 + trace, m[9] - m[6], m[2] - m[8], m[4] - m[1]};
  } else if (m[0] >= std::max(m[5], m[10])) {
    q = {m[9] - m[6], 1.0 + m[0] - m[5] - m[10], m[1] + m[4], m[2] + m[8]};
  } else if (m[5] >= m[10]) {
    q = {m[2] - m[8], m[1] + m[4], 1.0 - m[0] + m[5] - m[10], m[6] + m[9]};
  } else {
    q = {m[4] - m[1], m[2] + m[8], m[6] + m[9], 1.0 - m[0] - m[5] + m[10]};
  }
  return Pose{normalized(q), {m[3], m[7], m[11]}};
}

}  // namespace verge
