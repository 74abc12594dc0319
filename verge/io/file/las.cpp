// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/io/file/las.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/core.h>

#include "verge/io/file/gps_time.hpp"
#include "verge/io/file/las_header.hpp"

namespace verge::io {
namespace {

/// Fields that the two families of point records have in different places.
struct Attributes {
  std::uint8_t echo = 0;
  std::uint8_t label = 0;
  std::uint8_t user_data = 0;
  bool withheld = false;
  double time_s = 0.0;
};

std::uint8_t echo_of(unsigned return_number) {
  return static_cast<std::uint8_t>(return_number == 0 ? 0 : return_number - 1);
}

/// Of formats 0 to 5. LAS 1.0 has no marks beside the class.
Attributes legacy_attributes(Bytes record, const LasHeader& header) {
  const auto classes = load_le<std::uint8_t>(record, 15);
  const bool has_marks = header.minor_version > 0;
  return {.echo = echo_of(load_le<std::uint8_t>(record, 14) & 0x07U),
          .label = static_cast<std::uint8_t>(classes & (has_marks ? 0x1FU : 0xFFU)),
          .user_data = load_le<std::uint8_t>(record, 17),
          .withheld = has_marks && (classes & 0x80U) != 0,
          .time_s = has_gps_time(header.point_format) ? load_le<double>(record, 20) : 0.0};
}

/// Of formats 6 to 10.
Attributes las14_attributes(Bytes record) {
  return {.echo = echo_of(load_le<std::uint8_t>(record, 14) & 0x0FU),
          .label = load_le<std::uint8_t>(record, 16),
          .user_data = load_le<std::uint8_t>(record, 17),
          .withheld = (load_le<std::uint8_t>(record, 15) & 0x04U) != 0,
          .time_s = load_le<double>(record, 22)};
}

Vec3 position_of(Bytes record, const LasHeader& header) {
  return {load_le<std::int32_t>(record, 0) * header.scale.x + header.offset.x,
          load_le<std::int32_t>(record, 4) * header.scale.y + header.offset.y,
          load_le<std::int32_t>(record, 8) * header.scale.z + header.offset.z};
}

/// What is taken off the coordinates so that floats hold them.
Vec3 origin_of(Vec3 first) {
  constexpr double kNear = 1e4;
  const bool near = std::fabs(first.x) <= kNear && std::fabs(first.y) <= kNear && std::fabs(first.z) <= kNear;
  if (near || !std::isfinite(first.x + first.y + first.z)) return {};
  return {std::round(first.x), std::round(first.y), std::round(first.z)};
}

void append_point(Cloud& cloud, Bytes record, Vec3 p, const Attributes& attributes) {
  cloud.x.push_back(static_cast<float>(p.x));
  cloud.y.push_back(static_cast<float>(p.y));
  cloud.z.push_back(static_cast<float>(p.z));
  cloud.intensity.push_back(load_le<std::uint16_t>(record, 12));
  cloud.echo.push_back(attributes.echo);
  cloud.label.push_back(attributes.label);
}

/// Times count from the earliest, which is the stamp where they are absolute.
void settle_times(Decoded& out, const LasHeader& header) {
  std::vector<double>& times = out.cloud.time_s;
  if (times.empty()) return;
  const auto odd = [](double time) { return !std::isfinite(time); };
  if (std::any_of(times.begin(), times.end(), odd)) {
    out.notes.emplace_back("times are left out: some are not finite");
    times.clear();
    return;
  }
  const double first = *std::min_element(times.begin(), times.end());
  for (double& time : times) time -= first;
  if (header.gps_time_is_absolute) out.stamp_ns = unix_ns_of_adjusted_gps(first);
}

void note_oddities(Decoded& out, const LasHeader& header, Vec3 origin, std::size_t withheld) {
  if (!header.note.empty()) out.notes.push_back(header.note);
  if (has_colours(header.point_format)) out.notes.emplace_back("colours are not read");
  if (withheld > 0) out.notes.push_back(fmt::format("{} points marked as withheld are left out", withheld));
  if (origin == Vec3{}) return;
  out.notes.push_back(fmt::format("origin ({:.0f}, {:.0f}, {:.0f}) m is taken off the coordinates", origin.x,
                                  origin.y, origin.z));
  out.T_world_sensor = Pose{.rotation = {}, .translation = origin};
}

Decoded from_records(Bytes data, const LasHeader& header) {
  Decoded out;
  const Vec3 origin = origin_of(position_of(data, header));
  const bool rings = header.software == kLasSoftware;
  std::size_t withheld = 0;
  for (std::size_t i = 0; i < header.points; ++i) {
    const Bytes record = data.subspan(i * header.record_bytes, header.record_bytes);
    const Attributes attributes =
        is_las14_format(header.point_format) ? las14_attributes(record) : legacy_attributes(record, header);
    if (attributes.withheld) {
      ++withheld;
      continue;
    }
    append_point(out.cloud, record, position_of(record, header) - origin, attributes);
    if (rings) out.cloud.ring.push_back(attributes.user_data);
    if (has_gps_time(header.point_format)) out.cloud.time_s.push_back(attributes.time_s);
  }
  settle_times(out, header);
  note_oddities(out, header, origin, withheld);
  return out;
}

}  // namespace

Expected<Decoded> read_las(Input& input) {
  const auto header = read_las_header(input);
  if (!header) return Unexpected(header.error());
  const std::uint64_t length = header->points * header->record_bytes;  // checked against the size before
  if (auto allowed = input.allow(header->points, length); !allowed) return Unexpected(allowed.error());
  const auto data = input.read(header->points_offset, length);
  if (!data) return Unexpected(data.error());
  return from_records(*data, *header);
}

}  // namespace verge::io
