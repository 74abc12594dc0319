// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

#include "verge/core/bytes.hpp"
#include "verge/sensor/ibeo/alasca_scan.hpp"
#include "verge/sensor/ibeo/message.hpp"
#include "verge/sensor/ibeo/objects2221.hpp"
#include "verge/sensor/ibeo/scan2202.hpp"

// Messages for the tests of this room and of io.

namespace verge::testing {

/// 2012-09-21 20:06:44 UTC, as NTP.
inline constexpr std::uint64_t kNtp = (2'208'988'800ULL + 1'348'258'004ULL) << 32U;

/// A scan of `points` points 20 ms long that goes through all layers, echoes and flags.
[[nodiscard]] inline sensor::ibeo::LuxScan lux_scan(std::size_t points, std::uint16_t number = 7) {
  sensor::ibeo::LuxScan scan;
  scan.number = number;
  scan.status = 0x030B;
  scan.start_ntp = kNtp;
  scan.end_ntp = kNtp + (1ULL << 32U) / 50;
  scan.start_angle_ticks = 1600;
  scan.end_angle_ticks = -1600;
  for (std::size_t i = 0; i < points; ++i) {
    scan.points.push_back({.layer = static_cast<std::uint8_t>(i % 4),
                           .echo = static_cast<std::uint8_t>(i / 4 % 3),
                           .flags = static_cast<std::uint8_t>(1U << (i % 4)),
                           .angle_ticks = static_cast<std::int16_t>(1600 - 4 * static_cast<int>(i % 800)),
                           .range_cm = static_cast<std::uint16_t>(1000 + i),
                           .pulse_width_cm = static_cast<std::uint16_t>(100 + i % 50),
                           .reserved = static_cast<std::uint16_t>(i * 7)});
  }
  return scan;
}

/// A list of objects with so many contour points each; -1: the count is not known.
[[nodiscard]] inline sensor::ibeo::LuxObjects lux_objects(const std::vector<int>& contours) {
  sensor::ibeo::LuxObjects list{kNtp, {}};
  std::uint16_t n = 1;
  for (const int contour : contours) {
    sensor::ibeo::LuxObject object;
    object.id = n;
    object.age = static_cast<std::uint16_t>(10 * n);
    object.reference_point = {static_cast<std::int16_t>(1000 * n), static_cast<std::int16_t>(-200 * n)};
    object.bounding_box_width = 180;
    object.bounding_box_length = 450;
    object.absolute_velocity = {sensor::ibeo::kVelocityInvalid, 0};
    object.relative_velocity = {-120, 30};
    object.kind = sensor::ibeo::ObjectClass::kCar;
    object.class_certainty = 80;
    object.contour_unknown = contour < 0;
    for (int i = 0; i < contour; ++i) object.contour.push_back({static_cast<std::int16_t>(900 + i), -50});
    list.objects.push_back(object);
    ++n;
  }
  return list;
}

/// A scan of `points` points that goes through all layers and states.
[[nodiscard]] inline sensor::ibeo::AlascaScan alasca_scan(std::size_t points) {
  sensor::ibeo::AlascaScan scan{.version = 1,
                                .scanner_type = 3,
                                .ecu = 2,
                                .reserved = 0,
                                .time = 123456,
                                .start_angle_1e4_rad = 8727,
                                .end_angle_1e4_rad = -8727,
                                .number = 9,
                                .points = {}};
  for (std::size_t i = 0; i < points; ++i) {
    scan.points.push_back({.scanner = 1,
                           .layer = static_cast<std::uint8_t>(i % 4),
                           .echo = static_cast<std::uint8_t>(i % 3),
                           .status = sensor::ibeo::AlascaStatus{static_cast<std::uint8_t>(i % 5)},
                           .x_code = static_cast<std::int16_t>(1000 + i),
                           .y_code = static_cast<std::int16_t>(-500 + static_cast<int>(i)),
                           .z_code = -100,
                           .pulse_width = static_cast<std::uint16_t>(i)});
  }
  return scan;
}

/// A whole message.
[[nodiscard]] inline std::vector<std::byte> lux_message(std::uint16_t type,
                                                        const std::vector<std::byte>& body) {
  return sensor::ibeo::encode_message({.type = type, .ntp = kNtp}, body);
}
[[nodiscard]] inline std::vector<std::byte> lux_scan_message(std::size_t points, std::uint16_t number = 7) {
  return lux_message(sensor::ibeo::kScanType, sensor::ibeo::encode_scan(lux_scan(points, number)));
}
[[nodiscard]] inline std::vector<std::byte> alasca_scan_message(std::size_t points) {
  return sensor::ibeo::encode_alasca_message({.type = sensor::ibeo::kAlascaScanType, .time_ms = 5},
                                             sensor::ibeo::encode_alasca_scan(alasca_scan(points)));
}

/// One behind the other.
[[nodiscard]] inline std::vector<std::byte> joined(const std::vector<std::vector<std::byte>>& parts) {
  std::vector<std::byte> all;
  for (const auto& part : parts) all.insert(all.end(), part.begin(), part.end());
  return all;
}

/// `bytes` with `value` at `offset`, little-endian.
template <class T>
[[nodiscard]] std::vector<std::byte> patched(std::vector<std::byte> bytes, std::size_t offset, T value) {
  std::memcpy(bytes.data() + offset, &value, sizeof(T));
  return bytes;
}

}  // namespace verge::testing
