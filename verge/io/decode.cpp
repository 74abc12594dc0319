// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/io/decode.hpp"

#include <bit>
#include <cstdint>
#include <limits>
#include <utility>

#include <fmt/core.h>

#include "verge/io/file/csv.hpp"
#include "verge/io/file/kitti.hpp"
#include "verge/io/file/las.hpp"
#include "verge/io/file/nuscenes.hpp"
#include "verge/io/file/pcd.hpp"
#include "verge/io/file/ply.hpp"
#include "verge/io/formats.hpp"
#include "verge/io/sniff.hpp"

namespace verge::io {
namespace {

Expected<Decoded> read_format(Input& input, Format format) {
  switch (format) {
    case Format::kKitti:
      return read_kitti(input);
    case Format::kNuscenes:
      return read_nuscenes(input);
    case Format::kPcd:
      return read_pcd(input);
    case Format::kPly:
      return read_ply(input);
    case Format::kCsv:
      return read_csv(input);
    case Format::kLas:
      return read_las(input);
    default:
      break;
  }
  return Unexpected(
      input.error_at(ErrorCode::kUsage, 0, fmt::format("{} is a recording, not a scan", name_of(format))));
}

bool is_denormal(float value) {
  constexpr std::uint32_t kExponent = 0x7F80'0000U;
  constexpr std::uint32_t kFraction = 0x007F'FFFFU;
  const auto bits = std::bit_cast<std::uint32_t>(value);
  return (bits & kExponent) == 0 && (bits & kFraction) != 0;
}

void drop_denormals(Cloud& cloud) {
  for (std::size_t i = 0; i < cloud.x.size(); ++i) {
    const bool bad = is_denormal(cloud.x[i]) || is_denormal(cloud.y[i]) || is_denormal(cloud.z[i]);
    if (bad) cloud.x[i] = std::numeric_limits<float>::quiet_NaN();
  }
}

}  // namespace

Expected<DecodedScan> decode_input(Input& input, std::optional<Format> forced, std::optional<Format> bin) {
  const auto format = forced ? Expected<Format>(*forced) : sniff(input, bin);
  if (!format) return Unexpected(format.error());
  auto decoded = read_format(input, *format);
  if (!decoded) return Unexpected(decoded.error());
  drop_denormals(decoded->cloud);
  const std::size_t points = decoded->cloud.x.size();
  DecodedScan out{organise(std::move(decoded->cloud)), *format, std::move(decoded->notes)};
  if (out.organised.scan.size() == 0) {
    return Unexpected(input.error_at(ErrorCode::kDamaged, 0, "no point can be used",
                                     fmt::format("0 of {}", points), ">= 1"));
  }
  out.organised.scan.frame = frame_name(input.name());
  if (decoded->stamp_ns) out.organised.scan.stamp_ns = decoded->stamp_ns;
  return out;
}

Expected<Scan> decode(Bytes bytes, const std::string& name, const OpenOptions& options) {
  Input input = Input::of(bytes, name, {options.memory_max_bytes, options.timeout_ms});
  auto decoded = decode_input(input, options.format);
  if (!decoded) return Unexpected(decoded.error());
  for (const std::string& text : decoded->notes) note(options.log, fmt::format("{}: {}", name, text));
  note(options.log, fmt::format("{}: {}", name, decoded->organised.note));
  return std::move(decoded->organised.scan);
}

}  // namespace verge::io
