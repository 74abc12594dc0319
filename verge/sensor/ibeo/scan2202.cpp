// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/sensor/ibeo/scan2202.hpp"

#include <cassert>
#include <utility>

#include "verge/core/byte_writer.hpp"
#include "verge/sensor/ibeo/damaged.hpp"

namespace verge::sensor::ibeo {
namespace {

LuxPoint decode_point(Bytes point) {
  const auto layer_echo = load_le<std::uint8_t>(point, 0);
  return {.layer = static_cast<std::uint8_t>(layer_echo & 0x0FU),
          .echo = static_cast<std::uint8_t>(layer_echo >> 4U),
          .flags = load_le<std::uint8_t>(point, 1),
          .angle_ticks = load_le<std::int16_t>(point, 2),
          .range_cm = load_le<std::uint16_t>(point, 4),
          .pulse_width_cm = load_le<std::uint16_t>(point, 6),
          .reserved = load_le<std::uint16_t>(point, 8)};
}

void encode_point(ByteWriter& out, const LuxPoint& point) {
  assert(point.layer < 16 && point.echo < 16);
  out.le(static_cast<std::uint8_t>(point.layer | (point.echo << 4U))).le(point.flags);
  out.le(point.angle_ticks).le(point.range_cm).le(point.pulse_width_cm).le(point.reserved);
}

LuxScan decode_scan_header(Bytes body) {
  LuxScan scan;
  scan.number = load_le<std::uint16_t>(body, 0);
  scan.status = load_le<std::uint16_t>(body, 2);
  scan.sync_phase_offset = load_le<std::uint16_t>(body, 4);
  scan.start_ntp = load_le<std::uint64_t>(body, 6);
  scan.end_ntp = load_le<std::uint64_t>(body, 14);
  scan.ticks_per_turn = load_le<std::uint16_t>(body, 22);
  scan.start_angle_ticks = load_le<std::int16_t>(body, 24);
  scan.end_angle_ticks = load_le<std::int16_t>(body, 26);
  scan.mounting = {.yaw_ticks = load_le<std::int16_t>(body, 30),
                   .pitch_ticks = load_le<std::int16_t>(body, 32),
                   .roll_ticks = load_le<std::int16_t>(body, 34),
                   .x_cm = load_le<std::int16_t>(body, 36),
                   .y_cm = load_le<std::int16_t>(body, 38),
                   .z_cm = load_le<std::int16_t>(body, 40)};
  scan.flags = load_le<std::uint16_t>(body, 42);
  return scan;
}

}  // namespace

Expected<LuxScan> decode_scan(Bytes body, std::uint64_t at) {
  if (body.size() < kScanHeaderBytes) {
    return damaged(at, "scan is shorter than its header", fmt::format("{} B", body.size()), ">= 44 B");
  }
  const auto points = load_le<std::uint16_t>(body, 28);
  if (body.size() != kScanHeaderBytes + points * kScanPointBytes) {
    return damaged(at + 28, "size of a scan does not fit its points", fmt::format("{} B", body.size()),
                   fmt::format("44 + {} x 10 B", points));
  }
  LuxScan scan = decode_scan_header(body);
  if (scan.ticks_per_turn == 0)
    return damaged(at + 22, "a turn of a scan has no angle ticks", "0", "1 to 65535");
  if (scan.end_ntp < scan.start_ntp) return damaged(at + 14, "scan ends before it starts");
  scan.points.reserve(points);
  for (std::size_t i = 0; i < points; ++i) {
    scan.points.push_back(
        decode_point(body.subspan(kScanHeaderBytes + i * kScanPointBytes, kScanPointBytes)));
  }
  return scan;
}

std::vector<std::byte> encode_scan(const LuxScan& scan) {
  assert(scan.points.size() <= 65535);
  ByteWriter out;
  out.le(scan.number).le(scan.status).le(scan.sync_phase_offset).le(scan.start_ntp).le(scan.end_ntp);
  out.le(scan.ticks_per_turn).le(scan.start_angle_ticks).le(scan.end_angle_ticks);
  out.le(static_cast<std::uint16_t>(scan.points.size()));
  const Mounting& m = scan.mounting;
  out.le(m.yaw_ticks).le(m.pitch_ticks).le(m.roll_ticks).le(m.x_cm).le(m.y_cm).le(m.z_cm).le(scan.flags);
  for (const LuxPoint& point : scan.points) encode_point(out, point);
  return std::move(out).take();
}

}  // namespace verge::sensor::ibeo
