// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <numeric>

#include "verge/scan/ring_order.hpp"
#include "verge/scan/scan.hpp"

namespace verge {
namespace {

// Uniform motion from the sensor's pose at time 0 to its pose at time 1, in the frame of the former: a turn
// about one axis at a constant rate and a straight translation.
struct Sweep {
  Vec3 axis{0.0, 0.0, 1.0};
  double angle = 0.0;
  Vec3 translation;
};

Sweep sweep_of(const Motion& motion) {
  const Pose T_begin_end = inverse(motion.T_world_sensor_begin) * motion.T_world_sensor_end;
  const Quaternion& q = T_begin_end.rotation;
  const double sign = q.w < 0.0 ? -1.0 : 1.0;  // the shorter of the two ways round
  const Vec3 v = sign * Vec3{q.x, q.y, q.z};
  const double sine = norm(v);
  Sweep sweep{.translation = T_begin_end.translation};
  if (sine > 0.0) {
    sweep.axis = (1.0 / sine) * v;
    sweep.angle = 2.0 * std::atan2(sine, sign * q.w);
  }
  return sweep;
}

// p, seen at time t, from the pose at time 0. Rodrigues' formula for the rotation.
Vec3 seen_from_begin(const Sweep& sweep, double t, Vec3 p) {
  const double half_sine = std::sin(0.5 * sweep.angle * t);
  const double half_cosine = std::cos(0.5 * sweep.angle * t);
  const Vec3 turned = cross(sweep.axis, p);
  const Vec3 turned_twice = cross(sweep.axis, turned);
  return p + (2.0 * half_sine * half_cosine) * turned + (2.0 * half_sine * half_sine) * turned_twice +
         t * sweep.translation;
}

void move_points(Scan& scan, const Sweep& sweep, double duration_ns) {
  for (std::size_t i = 0; i < scan.size(); ++i) {
    if (scan.range[i] == 0.0F) continue;  // no return: nothing was seen from anywhere
    const double t = static_cast<double>(scan.time_offset_ns[i]) / duration_ns;
    const Vec3 p = seen_from_begin(sweep, t, scan.point(i));
    scan.x[i] = static_cast<float>(p.x);
    scan.y[i] = static_cast<float>(p.y);
    scan.z[i] = static_cast<float>(p.z);
  }
}

}  // namespace

Scan deskew(Scan scan) {
  if (scan.deskewed || !scan.motion || scan.motion->duration_ns <= 0) return scan;
  if (scan.time_offset_ns.size() != scan.size()) return scan;
  scan.deskewed = true;
  if (scan.motion->T_world_sensor_begin == scan.motion->T_world_sensor_end) return scan;
  move_points(scan, sweep_of(*scan.motion), static_cast<double>(scan.motion->duration_ns));
  measure_directions(scan);
  std::vector<std::uint32_t> order(scan.size());
  std::iota(order.begin(), order.end(), 0U);
  sort_rings_by_azimuth(scan, scan.ring_begin, order);
  permute_points(scan, order);
  return scan;
}

}  // namespace verge
