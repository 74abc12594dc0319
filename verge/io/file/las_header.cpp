// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/io/file/las_header.hpp"

#include <algorithm>
#include <cmath>
#include <string_view>
#include <utility>

#include <fmt/core.h>

#include "verge/io/text.hpp"

namespace verge::io {
namespace {

// Offsets of the fields in the header.
constexpr std::size_t kEncodingAt = 6;
constexpr std::size_t kMajorAt = 24;
constexpr std::size_t kMinorAt = 25;
constexpr std::size_t kSoftwareAt = 58;
constexpr std::size_t kSoftwareBytes = 32;
constexpr std::size_t kHeaderSizeAt = 94;
constexpr std::size_t kPointsOffsetAt = 96;
constexpr std::size_t kVlrCountAt = 100;
constexpr std::size_t kFormatAt = 104;
constexpr std::size_t kRecordBytesAt = 105;
constexpr std::size_t kLegacyCountAt = 107;
constexpr std::size_t kScaleAt = 131;
constexpr std::size_t kOffsetAt = 155;
constexpr std::size_t kCountAt = 247;  // of LAS 1.4

/// Least size of the header by minor version.
constexpr auto kHeaderBytes = std::to_array<std::uint16_t>({227, 227, 227, 235, 375});
constexpr int kFirstMinorWithEncoding = 2;
/// Least size of a record by point format.
constexpr auto kRecordBytes = std::to_array<std::uint16_t>({20, 28, 26, 34, 57, 63, 30, 36, 38, 59, 67});
constexpr std::uint64_t kVlrHeaderBytes = 54;
constexpr unsigned kCompressedBits = 0xC0;  // LASzip sets the highest bit of the point format

Unexpected unusable(const Input& input, std::uint64_t at, std::string what, std::string got = {},
                    std::string need = {}) {
  return Unexpected(
      input.error_at(ErrorCode::kUnusable, at, std::move(what), std::move(got), std::move(need)));
}

Vec3 load_vec(Bytes bytes, std::size_t at) {
  return {load_le<double>(bytes, at), load_le<double>(bytes, at + 8), load_le<double>(bytes, at + 16)};
}

std::string text_of(Bytes bytes, std::size_t at, std::size_t length) {
  const std::string_view text = as_text(bytes.subspan(at, length));
  return std::string(text.substr(0, text.find('\0')));
}

/// Signature, version and size of the header; the header's bytes.
Expected<Bytes> read_fixed_part(Input& input) {
  const auto start = input.head(kHeaderBytes[0]);
  if (!start) return Unexpected(start.error());
  if (!as_text(*start).starts_with("LASF")) {
    return unusable(input, 0, "is no LAS file", {},
                    "'LASF' at its begin");  // what stands there may be no text
  }
  if (start->size() < kHeaderBytes[0]) {
    return unusable(input, start->size(), "header of a LAS file is cut", fmt::format("{} B", start->size()),
                    ">= 227 B");
  }
  const int major = load_le<std::uint8_t>(*start, kMajorAt);
  const int minor = load_le<std::uint8_t>(*start, kMinorAt);
  if (major != 1 || minor > 4) {
    return unusable(input, kMajorAt, "version of a LAS file is not supported",
                    fmt::format("{}.{}", major, minor), "1.0 to 1.4");
  }
  const std::uint16_t least = kHeaderBytes[static_cast<std::size_t>(minor)];
  const auto size = load_le<std::uint16_t>(*start, kHeaderSizeAt);
  if (size < least || size > input.size()) {
    return unusable(input, kHeaderSizeAt, "size of the header is wrong", fmt::format("{} B", size),
                    fmt::format("{} to {} B", least, input.size()));
  }
  return input.head(size);
}

/// Number of points: LAS 1.4 has it in 64 bits, and again in the old place if it fits there.
void take_count(LasHeader& header, Bytes bytes) {
  const auto legacy = load_le<std::uint32_t>(bytes, kLegacyCountAt);
  header.points = legacy;
  if (header.minor_version < 4) return;
  const auto count = load_le<std::uint64_t>(bytes, kCountAt);
  if (count != 0) header.points = count;
  if (legacy != 0 && legacy != count) {
    header.note = fmt::format("number of points stands as {} and, for old readers, as {}: {} it is", count,
                              legacy, header.points);
  }
}

Expected<LasHeader> parse_fields(const Input& input, Bytes bytes) {
  LasHeader header;
  header.minor_version = load_le<std::uint8_t>(bytes, kMinorAt);
  header.software = text_of(bytes, kSoftwareAt, kSoftwareBytes);
  header.gps_time_is_absolute = header.minor_version >= kFirstMinorWithEncoding &&
                                (load_le<std::uint16_t>(bytes, kEncodingAt) & 1U) != 0;
  header.points_offset = load_le<std::uint32_t>(bytes, kPointsOffsetAt);
  header.point_format = load_le<std::uint8_t>(bytes, kFormatAt);
  header.record_bytes = load_le<std::uint16_t>(bytes, kRecordBytesAt);
  header.scale = load_vec(bytes, kScaleAt);
  header.offset = load_vec(bytes, kOffsetAt);
  if ((header.point_format & kCompressedBits) != 0) {
    return unusable(input, kFormatAt, "compressed LAS is not supported: unpack it first (laszip)");
  }
  if (header.point_format >= kRecordBytes.size()) {
    return unusable(input, kFormatAt, "point format is unknown", fmt::format("{}", header.point_format),
                    "0 to 10");
  }
  take_count(header, bytes);
  return header;
}

Expected<void> check_points(const Input& input, const LasHeader& header, std::uint64_t header_bytes) {
  const std::uint16_t least = las_record_bytes(header.point_format);
  if (header.record_bytes < least) {
    return unusable(input, kRecordBytesAt, "point record is shorter than its format",
                    fmt::format("{} B", header.record_bytes), fmt::format(">= {} B", least));
  }
  if (header.points_offset < header_bytes || header.points_offset > input.size()) {
    return unusable(input, kPointsOffsetAt, "points do not lie in the file",
                    fmt::format("{}", header.points_offset),
                    fmt::format("{} to {}", header_bytes, input.size()));
  }
  if (header.points == 0)
    return Unexpected(input.error_at(ErrorCode::kDamaged, kLegacyCountAt, "has 0 points"));
  const std::uint64_t left = input.size() - header.points_offset;
  if (header.points > left / header.record_bytes) {
    return unusable(input, header.minor_version < 4 ? kLegacyCountAt : kCountAt,
                    "number of points asks for more data than the file holds",
                    fmt::format("{} x {} B", header.points, header.record_bytes),
                    fmt::format("<= {} B", left));
  }
  return {};
}

Expected<void> check_scale(const Input& input, const LasHeader& header) {
  std::size_t at = kScaleAt;
  for (const double scale : {header.scale.x, header.scale.y, header.scale.z}) {
    if (!std::isfinite(scale) || scale == 0.0) {
      return unusable(input, at, "scale of a coordinate cannot be", fmt::format("{}", scale),
                      "finite and not 0");
    }
    at += sizeof(double);
  }
  for (const double offset : {header.offset.x, header.offset.y, header.offset.z}) {
    if (!std::isfinite(offset)) {
      return unusable(input, at, "offset of a coordinate is not finite", fmt::format("{}", offset));
    }
    at += sizeof(double);
  }
  return {};
}

/// The variable length records, one after the other between header and points. What stands in them (the
/// projection, extra bytes, waveforms) is not used: only that they end before the points.
Expected<void> walk_vlrs(Input& input, const LasHeader& header, std::uint64_t header_bytes,
                         std::uint32_t count) {
  std::uint64_t at = header_bytes;
  if (count > (header.points_offset - at) / kVlrHeaderBytes) {
    return unusable(input, kVlrCountAt, "variable length records do not fit before the points",
                    fmt::format("{}", count),
                    fmt::format("<= {}", (header.points_offset - at) / kVlrHeaderBytes));
  }
  for (std::uint32_t i = 0; i < count; ++i) {
    if (header.points_offset - at < kVlrHeaderBytes) {
      return unusable(input, at, "variable length record reaches into the points");
    }
    const auto bytes = input.read(at, kVlrHeaderBytes);
    if (!bytes) return Unexpected(bytes.error());
    const auto length = load_le<std::uint16_t>(*bytes, 20);
    if (length > header.points_offset - at - kVlrHeaderBytes) {
      return unusable(input, at + 20, "variable length record reaches into the points",
                      fmt::format("{} B", length),
                      fmt::format("<= {} B", header.points_offset - at - kVlrHeaderBytes));
    }
    at += kVlrHeaderBytes + length;
  }
  return {};
}

}  // namespace

std::uint16_t las_record_bytes(std::uint8_t point_format) { return kRecordBytes[point_format]; }

Expected<LasHeader> read_las_header(Input& input) {
  const auto bytes = read_fixed_part(input);
  if (!bytes) return Unexpected(bytes.error());
  const std::uint64_t header_bytes = bytes->size();
  const auto vlrs = load_le<std::uint32_t>(*bytes, kVlrCountAt);
  auto header = parse_fields(input, *bytes);
  if (!header) return header;
  if (auto checked = check_points(input, *header, header_bytes); !checked) return Unexpected(checked.error());
  if (auto checked = check_scale(input, *header); !checked) return Unexpected(checked.error());
  if (auto walked = walk_vlrs(input, *header, header_bytes, vlrs); !walked) return Unexpected(walked.error());
  return header;
}

}  // namespace verge::io
