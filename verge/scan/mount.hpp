// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>

#include "verge/core/fields.hpp"
#include "verge/core/vec.hpp"

namespace verge {

struct Scan;

/// How the sensor stands over the road: what turns its frame into the level vehicle frame.
///
/// The level frame has its origin on the road straight below the sensor, z up from the road's surface, x
/// along the forward axis: p_level = Rz(-forward) * Ry(pitch) * Rx(roll) * p_sensor + (0, 0, height).
struct Mount {
  double height_m = 0.0;   ///< Of the sensor's origin above the road below it.
  double pitch_rad = 0.0;  ///< Positive = nose down.
  double roll_rad = 0.0;   ///< Positive = left side up.
  double forward_rad =
      0.0;  ///< Direction of the road ahead in the sensor's levelled frame, from +x counter-clockwise.

  friend bool operator==(const Mount&, const Mount&) = default;
};

/// The rotation and shift of a mount, worked out once for many points.
class LevelFrame {
 public:
  explicit LevelFrame(const Mount& mount);

  /// p in the level frame.
  [[nodiscard]] Vec3 to_level(Vec3 p_sensor) const {
    return {dot(rows_[0], p_sensor), dot(rows_[1], p_sensor), dot(rows_[2], p_sensor) + height_m_};
  }
  /// Back: the inverse of to_level.
  [[nodiscard]] Vec3 to_sensor(Vec3 p_level) const;

 private:
  std::array<Vec3, 3> rows_;  // of the rotation from the sensor's frame to the level one
  double height_m_;
};

/// What is known of a mount beforehand; what is not is estimated from the scan.
struct MountHint {
  std::optional<double> height_m;
  std::optional<double> pitch_rad;
  std::optional<double> roll_rad;
  std::optional<double> forward_rad;
};

/// Settings of estimate_mount.
struct MountConfig {
  double reach_m = 14.0;
  double height_max_m = 5.0;
  double tilt_max_rad = 0.2618;
  double inlier_m = 0.05;
  double heading_max_rad = 0.7854;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor&& visit) {
    visit(self.reach_m,
          {"reach_m", "m", 2.0, 100.0, "returns farther away do not count for the road's plane", "ours"});
    visit(self.height_max_m,
          {"height_max_m", "m", 0.1, 50.0, "greatest height of a sensor over the road", "ours"});
    visit(self.tilt_max_rad,
          {"tilt_max_rad", "rad", 0.0, 1.0, "greatest pitch and roll that are looked for", "ours"});
    visit(self.inlier_m, {"inlier_m", "m", 0.005, 1.0,
                          "scale of the robust fit: the road's roughness and the range's noise", "ours"});
    visit(self.heading_max_rad,
          {"heading_max_rad", "rad", 0.0, 0.7854,
           "the road is looked for within this angle of +x; 0: it runs along +x", "ours"});
  }
};

/// Mount and how it came about.
struct MountEstimate {
  Mount mount;
  double inlier_share = 0.0;   ///< Share of the near low returns that lie on the plane, 0..1.
  bool plane_found = false;    ///< False: too few returns; height, pitch and roll are the hint's or 0.
  bool heading_found = false;  ///< False: no direction stands out; forward is the hint's or 0.
};

/// Height, pitch and roll by a robust plane through the road near the sensor; forward axis by the direction
/// in which the steps and walls beside the road run, nearest to +x. Hints are kept as they are. Needs no
/// knowledge of the sensor's model. The result does not depend on the order of the points, and is defined for
/// every scan.
[[nodiscard]] MountEstimate estimate_mount(const Scan& scan, const MountHint& hint = {},
                                           const MountConfig& config = {});

}  // namespace verge
