// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/sensor/ibeo/vehicle2805.hpp"

#include <utility>

#include "verge/core/byte_writer.hpp"
#include "verge/sensor/ibeo/damaged.hpp"

namespace verge::sensor::ibeo {

Expected<VehicleState> decode_vehicle_state(Bytes body, std::uint64_t at) {
  if (body.size() != 46) {
    return damaged(at, "size of a vehicle state is wrong", fmt::format("{} B", body.size()), "46 B");
  }
  return VehicleState{.ntp = load_le<std::uint64_t>(body, 0),
                      .scan_number = load_le<std::uint16_t>(body, 8),
                      .error_flags = load_le<std::uint16_t>(body, 10),
                      .velocity_cm_s = load_le<std::int16_t>(body, 12),
                      .steering_wheel_mrad = load_le<std::int16_t>(body, 14),
                      .front_wheel_1e4_rad = load_le<std::int16_t>(body, 16),
                      .reserved_1 = load_le<std::uint16_t>(body, 18),
                      .x_cm = load_le<std::int32_t>(body, 20),
                      .y_cm = load_le<std::int32_t>(body, 24),
                      .course_1e4_rad = load_le<std::int16_t>(body, 28),
                      .time_difference_ms = load_le<std::uint16_t>(body, 30),
                      .x_difference_mm = load_le<std::int16_t>(body, 32),
                      .y_difference_mm = load_le<std::int16_t>(body, 34),
                      .heading_difference_1e4_rad = load_le<std::int16_t>(body, 36),
                      .reserved_2 = load_le<std::uint16_t>(body, 38),
                      .yaw_rate_1e4_rad_s = load_le<std::int16_t>(body, 40),
                      .reserved_3 = load_le<std::uint32_t>(body, 42)};
}

std::vector<std::byte> encode_vehicle_state(const VehicleState& s) {
  ByteWriter out;
  out.le(s.ntp).le(s.scan_number).le(s.error_flags).le(s.velocity_cm_s).le(s.steering_wheel_mrad);
  out.le(s.front_wheel_1e4_rad).le(s.reserved_1).le(s.x_cm).le(s.y_cm).le(s.course_1e4_rad);
  out.le(s.time_difference_ms).le(s.x_difference_mm).le(s.y_difference_mm).le(s.heading_difference_1e4_rad);
  out.le(s.reserved_2).le(s.yaw_rate_1e4_rad_s).le(s.reserved_3);
  return std::move(out).take();
}

}  // namespace verge::sensor::ibeo
