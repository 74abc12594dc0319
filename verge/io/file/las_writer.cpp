// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string_view>
#include <utility>

#include <fmt/core.h>

#include "verge/core/atomic_file.hpp"
#include "verge/core/byte_writer.hpp"
#include "verge/io/file/gps_time.hpp"
#include "verge/io/file/las.hpp"
#include "verge/io/file/las_header.hpp"
#include "verge/io/text.hpp"

namespace verge::io {
namespace {

constexpr double kStep = 1e-4;  // metres
constexpr std::uint8_t kWrittenFormat = 6;
constexpr std::uint16_t kWrittenHeaderBytes = 375;

std::int32_t steps_of(float metres) {
  return static_cast<std::int32_t>(std::llround(static_cast<double>(metres) / kStep));
}

double intensity_factor(const std::vector<float>& intensity) {
  float most = 0.0F;
  for (const float value : intensity) most = std::max(most, value);
  return most <= 1.0F ? 65535.0 : most <= 255.0F ? 257.0 : 1.0;
}

std::uint16_t to_16_bits(double value) {
  if (!(value > 0.0)) return 0;  // NaN too
  return static_cast<std::uint16_t>(std::lround(std::min(value, 65535.0)));
}

/// Return number of a point, 1 to 15.
std::uint8_t return_of(const Scan& scan, std::size_t i) {
  const unsigned echo = scan.echo.empty() ? 0U : scan.echo[i];
  return static_cast<std::uint8_t>(std::min(echo, 14U) + 1U);
}

std::uint8_t class_of(const Scan& scan, std::size_t i) {
  const std::uint32_t label = scan.label.empty() ? 0U : scan.label[i];
  return static_cast<std::uint8_t>(label > 255U ? 0U : label);
}

double gps_time_of(const Scan& scan, std::size_t i) {
  const std::uint32_t offset_ns = scan.time_offset_ns.empty() ? 0U : scan.time_offset_ns[i];
  return scan.stamp_ns ? adjusted_gps_of(*scan.stamp_ns + offset_ns) : offset_ns * 1e-9;
}

void write_bounds(ByteWriter& out, const std::vector<float>& column) {
  std::int32_t least = 0;
  std::int32_t most = 0;
  if (!column.empty()) {
    const auto [low, high] = std::minmax_element(column.begin(), column.end());
    least = steps_of(*low);
    most = steps_of(*high);
  }
  out.le(most * kStep).le(least * kStep);
}

/// Points by return number, 1 to 15.
std::array<std::uint64_t, 15> count_returns(const Scan& scan) {
  std::array<std::uint64_t, 15> counts{};
  for (std::size_t i = 0; i < scan.size(); ++i) ++counts[return_of(scan, i) - 1U];
  return counts;
}

std::vector<std::byte> header_of(const Scan& scan) {
  constexpr std::uint16_t kAbsoluteTime = 0x01;
  constexpr std::uint16_t kWkt = 0x10;  // demanded of formats 6 to 10, also where there is no projection
  const auto fixed_text = [](ByteWriter& out, std::string_view text) {
    out.bytes(std::as_bytes(std::span(text.data(), text.size()))).zeros(32 - text.size());
  };
  ByteWriter out;
  out.bytes(std::as_bytes(std::span("LASF", 4))).le(std::uint16_t{0});
  out.le(static_cast<std::uint16_t>(kWkt | (scan.stamp_ns ? kAbsoluteTime : 0U))).zeros(16);
  out.le(std::uint8_t{1}).le(std::uint8_t{4});
  fixed_text(out, "OTHER");
  fixed_text(out, kLasSoftware);
  out.zeros(4).le(kWrittenHeaderBytes).le(std::uint32_t{kWrittenHeaderBytes}).le(std::uint32_t{0});
  out.le(kWrittenFormat).le(las_record_bytes(kWrittenFormat)).zeros(24);
  for (int axis = 0; axis < 3; ++axis) out.le(kStep);
  for (int axis = 0; axis < 3; ++axis) out.le(0.0);
  for (const auto* column : {&scan.x, &scan.y, &scan.z}) write_bounds(out, *column);
  out.zeros(8 + 8 + 4).le(static_cast<std::uint64_t>(scan.size()));
  for (const std::uint64_t count : count_returns(scan)) out.le(count);
  return std::move(out).take();
}

void append_record(ByteWriter& out, const Scan& scan, std::size_t i, std::uint8_t ring, double factor) {
  const std::uint8_t number = return_of(scan, i);
  out.le(steps_of(scan.x[i])).le(steps_of(scan.y[i])).le(steps_of(scan.z[i]));
  out.le(to_16_bits(scan.intensity.empty() ? 0.0 : static_cast<double>(scan.intensity[i]) * factor));
  out.le(static_cast<std::uint8_t>(number | (number << 4U)));
  out.le(std::uint8_t{0}).le(class_of(scan, i)).le(ring).zeros(4).le(gps_time_of(scan, i));
}

std::vector<std::byte> records_of(const Scan& scan, std::size_t ring, double factor) {
  const auto [begin, end] = scan.ring(ring);
  ByteWriter out;
  for (std::size_t i = begin; i < end; ++i)
    append_record(out, scan, i, static_cast<std::uint8_t>(ring), factor);
  return std::move(out).take();
}

Expected<void> check_writable(const std::filesystem::path& path, const Scan& scan) {
  const auto refuse = [&](std::string what, std::string got, std::string need) {
    return Unexpected(
        Error{ErrorCode::kUsage, path.string(), {}, std::move(what), std::move(got), std::move(need)});
  };
  if (scan.ring_count() > 256) {
    return refuse("scan has more rings than LAS user data can say", fmt::format("{}", scan.ring_count()),
                  "<= 256");
  }
  constexpr double kMost = std::numeric_limits<std::int32_t>::max() * kStep;
  for (const auto* column : {&scan.x, &scan.y, &scan.z}) {
    for (const float value : *column) {
      if (!(std::fabs(static_cast<double>(value)) <= kMost)) {
        return refuse("coordinate is too large for LAS", fmt::format("{} m", value),
                      fmt::format("<= {} m", kMost));
      }
    }
  }
  return {};
}

void log_losses(const std::filesystem::path& path, const Scan& scan, double factor, const Log& log) {
  const auto say = [&](const std::string& text) { note(log, fmt::format("{}: {}", path.string(), text)); };
  if (factor != 1.0 && !scan.intensity.empty()) say(fmt::format("intensity is multiplied by {:.0f}", factor));
  const auto big =
      std::count_if(scan.label.begin(), scan.label.end(), [](std::uint32_t label) { return label > 255; });
  if (big > 0) say(fmt::format("{} labels above 255 become class 0", big));
  const auto late =
      std::count_if(scan.echo.begin(), scan.echo.end(), [](std::uint8_t echo) { return echo > 14; });
  if (late > 0) say(fmt::format("{} echoes above 14 become return 15", late));
  if (!scan.pulse_width.empty()) say("pulse widths are left out");
  if (!scan.flags.empty()) say("flags are left out");
}

Expected<void> write(AtomicFile& file, const std::vector<std::byte>& bytes) {
  return file.write(as_text(bytes));
}

}  // namespace

Expected<void> write_las(const std::filesystem::path& path, const Scan& scan, const Log& log) {
  if (auto writable = check_writable(path, scan); !writable) return writable;
  auto file = AtomicFile::create(path);
  if (!file) return Unexpected(file.error());
  const double factor = intensity_factor(scan.intensity);
  if (auto written = write(*file, header_of(scan)); !written) return written;
  for (std::size_t ring = 0; ring < scan.ring_count(); ++ring) {
    if (auto written = write(*file, records_of(scan, ring, factor)); !written) return written;
  }
  log_losses(path, scan, factor, log);
  return file->commit();
}

}  // namespace verge::io
