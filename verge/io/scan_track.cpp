// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/io/scan_track.hpp"

namespace verge::io {
namespace {

constexpr std::int64_t kRevolution = 100'000'000;  // of most scanners on vehicles

}  // namespace

void ScanTrack::attach(Scan& scan, std::size_t row) const {
  if (row < stamps_ns.size() && !scan.stamp_ns) scan.stamp_ns = stamps_ns[row];
  if (row >= T_world_sensor.size()) return;
  scan.T_world_sensor = T_world_sensor[row];
  if (T_world_sensor.size() < 2) return;
  const bool last = row + 1 == T_world_sensor.size();
  const std::size_t from = last ? row - 1 : row;
  const Pose step = inverse(T_world_sensor[from]) * T_world_sensor[from + 1];
  const bool timed = from + 1 < stamps_ns.size() && stamps_ns[from + 1] > stamps_ns[from];
  scan.motion = Motion{.T_world_sensor_begin = T_world_sensor[row],
                       .T_world_sensor_end = T_world_sensor[row] * step,
                       .duration_ns = timed ? stamps_ns[from + 1] - stamps_ns[from] : kRevolution};
}

}  // namespace verge::io
