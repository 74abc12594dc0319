// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "verge/core/pose.hpp"
#include "verge/core/vec.hpp"
#include "verge/scan/mount.hpp"

namespace verge {

/// The vehicle's motion over one scan: the sensor's pose at the time of the first point and `duration_ns`
/// later, in one world frame. Between the two the motion is taken as uniform.
struct Motion {
  Pose T_world_sensor_begin;
  Pose T_world_sensor_end;
  std::int64_t duration_ns = 100'000'000;
};

/// What the sensor saw in one revolution: ring-major and ragged, structure of arrays.
///
/// Rings run from lowest to highest elevation; the points of ring r are [ring_begin[r], ring_begin[r + 1]),
/// in order of azimuth from -pi to pi, counter-clockwise. Frame: right-handed, x forward, y left, z up,
/// metres, radians; x, y, z are in the sensor frame at the point's own time unless `deskewed`. A return of
/// range 0 is no return, and only that. Optional columns are empty where the source does not have them, else
/// as long as x.
struct Scan {
  std::string frame;  ///< The file's name without suffix, or a running number.
  std::string frame_id = "sensor";
  std::string sensor;  ///< Model that measured it, as the option --model names it; empty: not known.
  std::optional<std::int64_t> stamp_ns;  ///< Time of the first point, ns since the Unix epoch.

  std::vector<std::uint32_t> ring_begin{0};  ///< ring_count() + 1 offsets into the columns.
  std::vector<float> azimuth;                ///< atan2(y, x), radians in [-pi, pi].
  std::vector<float> range;                  ///< Distance from the sensor, metres; 0 = no return.
  std::vector<float> x, y, z;
  std::vector<float> intensity;               ///< As the source scales it.
  std::vector<std::uint32_t> time_offset_ns;  ///< After stamp_ns; optional.
  std::vector<std::uint8_t> echo;             ///< 0 = first; optional.
  std::vector<float> pulse_width;             ///< Metres; optional.
  std::vector<std::uint32_t> flags;           ///< As the source sets them; optional.
  std::vector<std::uint32_t> label;           ///< Class of each point in the source's own numbers; optional.
  std::vector<std::uint32_t>
      input_index;  ///< Where the point stood in the input; a permutation with gaps at dropped points.

  std::optional<Motion> motion;
  std::optional<Pose> T_world_sensor;  ///< Pose at stamp_ns; optional.
  std::optional<Mount> mount;  ///< Given or estimated; a method that needs it and finds none estimates it.
  bool deskewed = false;
  std::uint64_t dropped = 0;  ///< Input points that were not finite and left out.

  [[nodiscard]] std::size_t size() const { return x.size(); }
  [[nodiscard]] std::size_t ring_count() const { return ring_begin.size() - 1; }
  [[nodiscard]] Vec3 point(std::size_t i) const { return {x[i], y[i], z[i]}; }
  /// First and past-the-last index of ring r.
  [[nodiscard]] std::pair<std::size_t, std::size_t> ring(std::size_t r) const {
    return {ring_begin[r], ring_begin[r + 1]};
  }
};

/// The scan with every point where it would have been seen from the sensor's pose at stamp_ns (point by
/// point, from `motion` and `time_offset_ns`), with the rings kept and re-sorted by the new azimuth; range
/// and azimuth follow. Unchanged where it is deskewed already, or has no motion or no times.
[[nodiscard]] Scan deskew(Scan scan);

}  // namespace verge
