// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "verge/core/bytes.hpp"
#include "verge/core/error.hpp"

namespace verge::sensor::ibeo {

/// The vehicle's motion as the sensor has it from the CAN bus, as in a message of type 0x2805.
struct VehicleState {
  std::uint64_t ntp = 0;
  std::uint16_t scan_number = 0;
  std::uint16_t error_flags = 0;   ///< 0x0001 no axle distance, 0x0800 no CAN data.
  std::int16_t velocity_cm_s = 0;  ///< Forward.
  std::int16_t steering_wheel_mrad = 0;
  std::int16_t front_wheel_1e4_rad = 0;  ///< 1e-4 rad.
  std::uint16_t reserved_1 = 0;
  std::int32_t x_cm = 0;  ///< From where the sensor began to count.
  std::int32_t y_cm = 0;
  std::int16_t course_1e4_rad = 0;       ///< 1e-4 rad.
  std::uint16_t time_difference_ms = 0;  ///< Since the message before.
  std::int16_t x_difference_mm = 0;      ///< Driven in that time.
  std::int16_t y_difference_mm = 0;
  std::int16_t heading_difference_1e4_rad = 0;  ///< Turned in that time, 1e-4 rad.
  std::uint16_t reserved_2 = 0;
  std::int16_t yaw_rate_1e4_rad_s = 0;  ///< 1e-4 rad/s, from the latest CAN message.
  std::uint32_t reserved_3 = 0;

  friend bool operator==(const VehicleState&, const VehicleState&) = default;
};

/// The state in the body of a message. Fails with kDamaged where its size is not 46.
[[nodiscard]] Expected<VehicleState> decode_vehicle_state(Bytes body, std::uint64_t at = 0);
[[nodiscard]] std::vector<std::byte> encode_vehicle_state(const VehicleState& state);

}  // namespace verge::sensor::ibeo
