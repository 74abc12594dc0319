// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/sensor/ibeo/alasca_scan.hpp"

#include <cassert>
#include <cmath>
#include <utility>

#include "verge/core/byte_writer.hpp"
#include "verge/sensor/ibeo/damaged.hpp"

namespace verge::sensor::ibeo {
namespace {

constexpr int kLastCmCode = 10000;

AlascaPoint decode_point(Bytes point) {
  return {.scanner = load_be<std::uint8_t>(point, 0),
          .layer = load_be<std::uint8_t>(point, 1),
          .echo = load_be<std::uint8_t>(point, 2),
          .status = AlascaStatus{load_be<std::uint8_t>(point, 3)},
          .x_code = load_be<std::int16_t>(point, 4),
          .y_code = load_be<std::int16_t>(point, 6),
          .z_code = load_be<std::int16_t>(point, 8),
          .pulse_width = load_be<std::uint16_t>(point, 10)};
}

void encode_point(ByteWriter& out, const AlascaPoint& point) {
  out.be(point.scanner).be(point.layer).be(point.echo).be(static_cast<std::uint8_t>(point.status));
  out.be(point.x_code).be(point.y_code).be(point.z_code).be(point.pulse_width);
}

}  // namespace

AlascaHeader decode_alasca_header(Bytes header) {
  return {load_be<std::uint32_t>(header, 4), load_be<std::uint32_t>(header, 8),
          load_be<std::uint32_t>(header, 12)};
}

std::vector<std::byte> encode_alasca_message(const AlascaHeader& header, Bytes body) {
  ByteWriter out;
  out.bytes(kAlascaFrames.magic).be(static_cast<std::uint32_t>(body.size()));
  out.be(header.type).be(header.time_ms).bytes(body);
  return std::move(out).take();
}

double metres_of_code(std::int16_t code) {
  if (code > kLastCmCode) return 0.1 * code - 900.0;
  if (code < -kLastCmCode) return 0.1 * code + 900.0;
  return 0.01 * code;
}

std::optional<std::int16_t> code_of_metres(double metres) {
  if (!std::isfinite(metres)) return std::nullopt;
  double code = std::round(metres * 100.0);
  if (std::fabs(code) > kLastCmCode) {
    const double size = std::round((std::fabs(metres) + 900.0) * 10.0);
    code = std::copysign(size, metres);
  }
  if (code < -32768.0 || code > 32767.0) return std::nullopt;
  return static_cast<std::int16_t>(code);
}

Expected<AlascaScan> decode_alasca_scan(Bytes body, std::uint64_t at) {
  if (body.size() < kAlascaScanHeaderBytes) {
    return damaged(at, "scan is shorter than its header", fmt::format("{} B", body.size()), ">= 16 B");
  }
  const auto points = load_be<std::uint16_t>(body, 14);
  if (points > kAlascaPointsMost) {
    return damaged(at + 14, "scan has more points than the sensor", fmt::format("{}", points), "<= 8648");
  }
  if (body.size() != kAlascaScanHeaderBytes + points * kAlascaPointBytes) {
    return damaged(at + 14, "size of a scan does not fit its points", fmt::format("{} B", body.size()),
                   fmt::format("16 + {} x 12 B", points));
  }
  AlascaScan scan{.version = load_be<std::uint8_t>(body, 0),
                  .scanner_type = load_be<std::uint8_t>(body, 1),
                  .ecu = load_be<std::uint8_t>(body, 2),
                  .reserved = load_be<std::uint8_t>(body, 3),
                  .time = load_be<std::uint32_t>(body, 4),
                  .start_angle_1e4_rad = load_be<std::int16_t>(body, 8),
                  .end_angle_1e4_rad = load_be<std::int16_t>(body, 10),
                  .number = load_be<std::uint16_t>(body, 12),
                  .points = {}};
  scan.points.reserve(points);
  for (std::size_t i = 0; i < points; ++i) {
    scan.points.push_back(
        decode_point(body.subspan(kAlascaScanHeaderBytes + i * kAlascaPointBytes, kAlascaPointBytes)));
  }
  return scan;
}

std::vector<std::byte> encode_alasca_scan(const AlascaScan& scan) {
  assert(scan.points.size() <= kAlascaPointsMost);
  ByteWriter out;
  out.be(scan.version).be(scan.scanner_type).be(scan.ecu).be(scan.reserved).be(scan.time);
  out.be(scan.start_angle_1e4_rad).be(scan.end_angle_1e4_rad).be(scan.number);
  out.be(static_cast<std::uint16_t>(scan.points.size()));
  for (const AlascaPoint& point : scan.points) encode_point(out, point);
  return std::move(out).take();
}

}  // namespace verge::sensor::ibeo
