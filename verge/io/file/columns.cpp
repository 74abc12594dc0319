// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/io/file/columns.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>
#include <type_traits>
#include <utility>

#include <fmt/core.h>

namespace verge::io {
namespace {

constexpr double kAbsoluteNanoseconds = 1e17;  // 1973
constexpr double kNoTimeShare = 0.5;  // of the latest absolute time: what lies below is no time (no return)
constexpr double kSecondsPerNanosecond = 1e-9;

/// Names in order of preference.
constexpr std::array<std::pair<std::string_view, Role>, 29> kNames{{{"x", Role::kX},
                                                                    {"y", Role::kY},
                                                                    {"z", Role::kZ},
                                                                    {"intensity", Role::kIntensity},
                                                                    {"i", Role::kIntensity},
                                                                    {"reflectivity", Role::kIntensity},
                                                                    {"reflectance", Role::kIntensity},
                                                                    {"remission", Role::kIntensity},
                                                                    {"ring", Role::kRing},
                                                                    {"channel", Role::kRing},
                                                                    {"line", Role::kRing},
                                                                    {"row", Role::kRing},
                                                                    {"level", Role::kRing},
                                                                    {"layer", Role::kRing},
                                                                    {"t", Role::kTime},
                                                                    {"time", Role::kTime},
                                                                    {"timestamp", Role::kTime},
                                                                    {"timestamps", Role::kTime},
                                                                    {"time_stamp", Role::kTime},
                                                                    {"stamp", Role::kTime},
                                                                    {"stamps", Role::kTime},
                                                                    {"offset_time", Role::kTime},
                                                                    {"label", Role::kLabel},
                                                                    {"labels", Role::kLabel},
                                                                    {"echo", Role::kEcho},
                                                                    {"return_number", Role::kEcho},
                                                                    {"pulse_width", Role::kPulseWidth},
                                                                    {"echo_width", Role::kPulseWidth},
                                                                    {"flags", Role::kFlags}}};

std::string plain_name(std::string_view name) {
  constexpr std::string_view kPrefix = "scalar_";
  std::string lower(name);
  for (char& c : lower) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return lower.starts_with(kPrefix) ? lower.substr(kPrefix.size()) : lower;
}

/// The value in T; one that T cannot hold becomes infinite (floats) or the nearest (integers).
template <class To, class From>
To convert(From value) {
  if constexpr (std::is_same_v<To, float> && std::is_same_v<From, double>) {
    constexpr double kMax = std::numeric_limits<float>::max();
    if (std::fabs(value) > kMax)
      return std::copysign(std::numeric_limits<float>::infinity(), static_cast<float>(value > 0 ? 1 : -1));
    return static_cast<float>(value);
  } else if constexpr (std::is_integral_v<To> && std::is_same_v<From, std::uint64_t>) {
    return static_cast<To>(std::min<std::uint64_t>(value, std::numeric_limits<std::int64_t>::max()));
  } else {
    return static_cast<To>(value);
  }
}

template <class From, class To>
void copy_as(const Column& column, std::span<To> out) {
  std::size_t at = column.offset;
  for (To& value : out) {
    value =
        convert<To>(column.big_endian ? load_be<From>(column.bytes, at) : load_le<From>(column.bytes, at));
    at += column.stride;
  }
}

template <class To>
void copy_floats(const Column& column, std::span<To> out) {
  if (column.type == Scalar::kF32) {
    copy_as<float>(column, out);
  } else {
    copy_as<double>(column, out);
  }
}

/// The column's numbers as To: float or double of any type, std::int64_t of integers.
template <class To>
std::vector<To> values_of(const Column& column, std::size_t points) {
  std::vector<To> out(points);
  const std::span<To> span(out);
  switch (column.type) {
    case Scalar::kI8:
      copy_as<std::int8_t>(column, span);
      break;
    case Scalar::kU8:
      copy_as<std::uint8_t>(column, span);
      break;
    case Scalar::kI16:
      copy_as<std::int16_t>(column, span);
      break;
    case Scalar::kU16:
      copy_as<std::uint16_t>(column, span);
      break;
    case Scalar::kI32:
      copy_as<std::int32_t>(column, span);
      break;
    case Scalar::kU32:
      copy_as<std::uint32_t>(column, span);
      break;
    case Scalar::kI64:
      copy_as<std::int64_t>(column, span);
      break;
    case Scalar::kU64:
      copy_as<std::uint64_t>(column, span);
      break;
    case Scalar::kF32:
    case Scalar::kF64:
      if constexpr (std::is_floating_point_v<To>) copy_floats(column, span);
      break;
  }
  return out;
}

bool is_ring(double value) {
  return value == std::floor(value) &&
         std::fabs(value) <= static_cast<double>(std::numeric_limits<std::int32_t>::max());
}

/// How times are counted.
struct TimeUnit {
  bool absolute = false;  ///< Since the Unix epoch.
  std::int64_t nanoseconds = 1'000'000'000;
};

/// By size: a time since 1970 in nanoseconds, microseconds, milliseconds or seconds (these since 1973), or
/// seconds of a scan. What would lie after 2262 in a unit is counted in the next smaller one: 64 bits of
/// nanoseconds end there.
TimeUnit unit_of(double greatest) {
  constexpr double kLastNanosecond = 9.2e18;
  for (const std::int64_t unit : {1'000, 1'000'000, 1'000'000'000}) {
    if (greatest > kLastNanosecond / static_cast<double>(unit)) return {true, unit / 1'000};
  }
  if (greatest > kAbsoluteNanoseconds * 1e-9) return {true, 1'000'000'000};
  return {};
}

bool is_time(double value) { return std::fabs(value) < 9e18; }  // NaN is none; every other fits 64 bits

std::int64_t nanoseconds_of(double value, const TimeUnit& unit) {
  // Whole units apart: 1.7e9 s in nanoseconds is more than a double holds exactly.
  const double whole = std::floor(value);
  return static_cast<std::int64_t>(whole) * unit.nanoseconds +
         std::llround((value - whole) * static_cast<double>(unit.nanoseconds));
}

/// What T cannot hold becomes 0.
template <class T>
std::vector<T> whole_numbers(std::span<const double> values) {
  constexpr double kMax = std::numeric_limits<T>::max();
  std::vector<T> whole(values.size());
  std::transform(values.begin(), values.end(), whole.begin(),
                 [](double value) { return value >= 0 && value <= kMax ? static_cast<T>(value) : T{0}; });
  return whole;
}

}  // namespace

std::size_t size_of(Scalar type) {
  constexpr std::array<std::size_t, 10> kSizes{1, 1, 2, 2, 4, 4, 8, 8, 4, 8};
  return kSizes[static_cast<std::size_t>(type)];
}

bool is_integer(Scalar type) { return type != Scalar::kF32 && type != Scalar::kF64; }

RoleFields assign_roles(std::span<const std::string> names) {
  RoleFields fields;
  std::vector<std::string> plain;
  for (const std::string& name : names) plain.push_back(plain_name(name));
  for (const auto& [name, role] : kNames) {
    auto& field = fields[static_cast<std::size_t>(role)];
    const auto found = std::find(plain.begin(), plain.end(), name);
    if (!field && found != plain.end()) field = static_cast<std::size_t>(found - plain.begin());
  }
  return fields;
}

std::vector<float>* CloudBuilder::floats_of(Role role) {
  switch (role) {
    case Role::kX:
      return &out_.cloud.x;
    case Role::kY:
      return &out_.cloud.y;
    case Role::kZ:
      return &out_.cloud.z;
    case Role::kIntensity:
      return &out_.cloud.intensity;
    case Role::kPulseWidth:
      return &out_.cloud.pulse_width;
    default:
      return nullptr;
  }
}

void CloudBuilder::set_rings(std::span<const double> values) {
  out_.cloud.ring.resize(points_);
  no_ring_.assign(points_, 0);
  for (std::size_t i = 0; i < points_; ++i) {
    const bool good = is_ring(values[i]);
    out_.cloud.ring[i] = good ? static_cast<std::int64_t>(values[i]) : 0;
    no_ring_[i] = good ? 0 : 1;
  }
}

void CloudBuilder::add(Role role, const Column& column) {
  if (auto* floats = floats_of(role)) {
    *floats = values_of<float>(column, points_);
  } else if (role == Role::kTime && is_integer(column.type)) {
    set_times(values_of<std::int64_t>(column, points_), out_);
  } else {
    add(role, values_of<double>(column, points_), column.type);
  }
}

void CloudBuilder::add(Role role, std::span<const double> values, Scalar type) {
  if (auto* floats = floats_of(role)) {
    floats->resize(points_);
    std::transform(values.begin(), values.end(), floats->begin(), convert<float, double>);
  } else if (role == Role::kRing) {
    set_rings(values);
  } else if (role == Role::kTime) {
    set_times(values, type, out_);
  } else if (role == Role::kEcho) {
    out_.cloud.echo = whole_numbers<std::uint8_t>(values);
  } else {
    (role == Role::kLabel ? out_.cloud.label : out_.cloud.flags) = whole_numbers<std::uint32_t>(values);
  }
}

Decoded CloudBuilder::take() && {
  std::size_t bad = 0;
  for (std::size_t i = 0; i < no_ring_.size(); ++i) {
    if (no_ring_[i] == 0) continue;
    out_.cloud.x[i] = std::numeric_limits<float>::quiet_NaN();
    ++bad;
  }
  if (bad > 0)
    out_.notes.push_back(fmt::format("{} of {} points have no valid ring and are dropped", bad, points_));
  return std::move(out_);
}

void set_times(std::span<const double> values, Scalar type, Decoded& out) {
  double greatest = 0.0;
  for (const double value : values) greatest = is_time(value) ? std::max(greatest, value) : greatest;
  const TimeUnit unit = is_integer(type) ? TimeUnit{greatest > kAbsoluteNanoseconds, 1} : unit_of(greatest);
  if (unit.absolute && type == Scalar::kF32) {
    out.notes.emplace_back("times are absolute but only float32, too coarse to be used");
    return;
  }
  const double least = unit.absolute ? greatest * kNoTimeShare : -std::numeric_limits<double>::infinity();
  double first = unit.absolute ? greatest : 0.0;
  if (unit.absolute) {
    for (const double value : values) first = value > least ? std::min(first, value) : first;
    out.stamp_ns = nanoseconds_of(first, unit);
  }
  out.cloud.time_s.resize(values.size());
  std::transform(values.begin(), values.end(), out.cloud.time_s.begin(), [&](double value) {
    if (!is_time(value) || value <= least) return 0.0;
    return (value - first) * (static_cast<double>(unit.nanoseconds) * kSecondsPerNanosecond);
  });
}

void set_times(std::span<const std::int64_t> values_ns, Decoded& out) {
  constexpr auto kAbsolute = static_cast<std::int64_t>(kAbsoluteNanoseconds);
  std::int64_t first = std::numeric_limits<std::int64_t>::max();
  for (const std::int64_t value : values_ns) first = value > kAbsolute ? std::min(first, value) : first;
  const bool absolute = first != std::numeric_limits<std::int64_t>::max();
  if (absolute) out.stamp_ns = first;
  out.cloud.time_s.resize(values_ns.size());
  std::transform(values_ns.begin(), values_ns.end(), out.cloud.time_s.begin(), [&](std::int64_t value) {
    if (!absolute) return static_cast<double>(value) * kSecondsPerNanosecond;
    return value > kAbsolute ? static_cast<double>(value - first) * kSecondsPerNanosecond : 0.0;
  });
}

}  // namespace verge::io
