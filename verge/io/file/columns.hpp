// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "verge/core/bytes.hpp"
#include "verge/io/file/decoded.hpp"

namespace verge::io {

/// How a file stores a number.
enum class Scalar : std::uint8_t { kI8, kU8, kI16, kU16, kI32, kU32, kI64, kU64, kF32, kF64 };

[[nodiscard]] std::size_t size_of(Scalar type);
[[nodiscard]] bool is_integer(Scalar type);

/// The numbers of one field in a block of bytes: point i has its value at offset + i * stride. The maker has
/// checked that the last one lies inside.
struct Column {
  Bytes bytes;
  std::size_t offset = 0;
  std::size_t stride = 0;
  Scalar type = Scalar::kF32;
  bool big_endian = false;
};

/// What a field means to us.
enum class Role : std::uint8_t { kX, kY, kZ, kIntensity, kRing, kTime, kLabel, kEcho, kPulseWidth, kFlags };
inline constexpr std::size_t kRoles = 10;

/// For each role the index of the field that has it. Where several could (intensity and reflectivity), the
/// name that drivers use most wins.
using RoleFields = std::array<std::optional<std::size_t>, kRoles>;

/// Roles by the names of the fields, without regard to case: x, y, z; intensity, i, reflectivity, remission;
/// ring, channel, line, row, level, layer; t, time, timestamp, timestamps, time_stamp, stamps, offset_time;
/// label; echo, return_number; pulse_width, echo_width; flags. A prefix "scalar_" (CloudCompare) does not
/// count.
[[nodiscard]] RoleFields assign_roles(std::span<const std::string> names);

/// Sets time_s and stamp_ns from a field of times: integers are nanoseconds (absolute beyond 1e17); float64
/// is absolute nanoseconds beyond 1e17, microseconds beyond 1e14, milliseconds beyond 1e11, seconds beyond
/// 1e8, else seconds of the scan; float32 is seconds of the scan. A time of 0 beside absolute ones is no time
/// (no return).
void set_times(std::span<const double> values, Scalar type, Decoded& out);
/// The same for integers, exact.
void set_times(std::span<const std::int64_t> values_ns, Decoded& out);

/// Fills the cloud's columns, role by role.
class CloudBuilder {
 public:
  explicit CloudBuilder(std::size_t points) : points_(points) {}

  /// A field stored as bytes.
  void add(Role role, const Column& column);
  /// A field read from text; `type` is what the header says (kF64 where it says nothing).
  void add(Role role, std::span<const double> values, Scalar type);
  /// Times that are known to the nanosecond.
  void add_times(std::span<const std::int64_t> values_ns) { set_times(values_ns, out_); }

  /// The cloud. A ring that is no integer of 32 bits makes its point not finite, so that it is dropped and
  /// counted.
  [[nodiscard]] Decoded take() &&;

 private:
  [[nodiscard]] std::vector<float>* floats_of(Role role);
  void set_rings(std::span<const double> values);

  std::size_t points_;
  Decoded out_;
  std::vector<std::uint8_t> no_ring_;
};

}  // namespace verge::io
