// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "verge/core/bytes.hpp"
#include "verge/core/error.hpp"

namespace verge::sensor::ibeo {

/// A pair of numbers about x and y, as the sensor sends it: centimetres, or cm/s; x forward, y left.
template <class T>
struct Pair {
  T x = 0;
  T y = 0;

  friend bool operator==(const Pair&, const Pair&) = default;
};

/// What kind of object the sensor takes it for.
enum class ObjectClass : std::uint16_t {
  kUnclassified = 0,
  kUnknownSmall = 1,
  kUnknownBig = 2,
  kPedestrian = 3,
  kBike = 4,
  kCar = 5,
  kTruck = 6,
};

/// An absolute velocity below this (x, cm/s) says that there is none: the relative one holds.
inline constexpr std::int16_t kVelocityInvalid = -32000;

/// A number of contour points that says that it is not known.
inline constexpr std::uint16_t kContourUnknown = 0xFFFF;

/// One tracked object.
struct LuxObject {
  std::uint16_t id = 0;
  std::uint16_t age = 0;             ///< Scans since it was first seen.
  std::uint16_t prediction_age = 0;  ///< Scans since it was last seen.
  std::uint16_t relative_time = 0;
  Pair<std::int16_t> reference_point{};
  Pair<std::uint16_t> reference_point_sigma{};
  Pair<std::int16_t> closest_point{};
  Pair<std::int16_t> bounding_box_centre{};
  std::uint16_t bounding_box_width = 0;   ///< Along y; it stands before the length.
  std::uint16_t bounding_box_length = 0;  ///< Along x.
  Pair<std::int16_t> box_centre{};
  Pair<std::uint16_t> box_size{};
  std::int16_t box_orientation_ticks = 0;  ///< 32 a degree.
  Pair<std::int16_t> absolute_velocity{};  ///< See kVelocityInvalid.
  Pair<std::uint16_t> velocity_sigma{};
  Pair<std::int16_t> relative_velocity{};
  ObjectClass kind = ObjectClass::kUnclassified;
  std::uint16_t class_age = 0;
  std::uint16_t class_certainty = 0;  ///< Per cent.
  std::vector<Pair<std::int16_t>> contour{};
  bool contour_unknown = false;  ///< The count stands as kContourUnknown.

  friend bool operator==(const LuxObject&, const LuxObject&) = default;
};

/// The objects of a scan, as in a message of type 0x2221.
struct LuxObjects {
  std::uint64_t scan_start_ntp = 0;
  std::vector<LuxObject> objects{};

  friend bool operator==(const LuxObjects&, const LuxObjects&) = default;
};

/// The objects in the body of a message. A contour count of 0xFFFF stands for no point or for one, as drivers
/// disagree: what makes the list end with the body, for all objects alike. Fails with kDamaged where neither
/// does.
[[nodiscard]] Expected<LuxObjects> decode_objects(Bytes body, std::uint64_t at = 0);

/// The body of the message. At most 65535 objects, and 65534 contour points each.
[[nodiscard]] std::vector<std::byte> encode_objects(const LuxObjects& objects);

}  // namespace verge::sensor::ibeo
