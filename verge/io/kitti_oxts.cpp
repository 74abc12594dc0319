// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/io/kitti_oxts.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <system_error>
#include <utility>

#include <fmt/core.h>

#include "verge/core/angle.hpp"
#include "verge/io/files.hpp"
#include "verge/io/kitti_sequence.hpp"
#include "verge/io/lines.hpp"

namespace verge::io {
namespace fs = std::filesystem;
namespace {

/// So many numbers of a line; none where there are fewer or one is not finite.
template <std::size_t N>
std::optional<std::array<double, N>> numbers_of(std::string_view line) {
  std::array<double, N> values{};
  WordReader words(line, 1);
  for (double& value : values) {
    const auto word = words.next();
    const auto number = word ? parse_number<double>(word->text) : std::nullopt;
    if (!number || !std::isfinite(*number)) return std::nullopt;
    value = *number;
  }
  return values;
}

/// T_lidar_imu of calib_imu_to_velo.txt: lines "R: 9 numbers" and "T: 3 numbers" among others.
std::optional<Pose> read_T_lidar_imu(const fs::path& path, const InputLimits& limits) {
  std::optional<std::array<double, 9>> R;
  std::optional<std::array<double, 3>> T;
  const auto lines = read_lines<bool>(path, limits, [&](std::string_view line) {
    if (line.starts_with("R:")) R = numbers_of<9>(line.substr(2));
    if (line.starts_with("T:")) T = numbers_of<3>(line.substr(2));
    return std::optional(true);
  });
  if (!lines || !R || !T) return std::nullopt;
  const auto& r = *R;
  return pose_from_matrix({r[0], r[1], r[2], (*T)[0], r[3], r[4], r[5], (*T)[1], r[6], r[7], r[8], (*T)[2]});
}

/// The fixes of a drive, one a file.
struct Track {
  std::vector<std::int64_t> stamps_ns;
  std::vector<OxtsFix> fixes;
};

Expected<Track> read_track(const fs::path& oxts, const InputLimits& limits) {
  auto stamps = read_lines<std::int64_t>(oxts / "timestamps.txt", limits, &parse_date_time);
  if (!stamps) return Unexpected(stamps.error());
  Track track{*std::move(stamps), {}};
  std::vector<fs::path> files;
  std::error_code error;
  for (fs::directory_iterator entry(oxts / "data", error), end; !error && entry != end;
       entry.increment(error)) {
    if (entry->path().extension() == ".txt") files.push_back(entry->path());
  }
  std::sort(files.begin(), files.end(), [](const fs::path& a, const fs::path& b) {
    return natural_less(a.filename().string(), b.filename().string());
  });
  for (const fs::path& file : files) {
    const auto rows = read_lines<OxtsFix>(file, limits, &parse_oxts);
    if (!rows) return Unexpected(rows.error());
    if (!rows->empty()) track.fixes.push_back(rows->front());
  }
  if (!track.fixes.empty() && track.fixes.size() == track.stamps_ns.size()) return track;
  return Unexpected({ErrorCode::kUnusable,
                     oxts.string(),
                     {},
                     "times and fixes do not fit",
                     fmt::format("{} times, {} fixes", track.stamps_ns.size(), track.fixes.size()),
                     "as many of both, at least 1"});
}

/// Where the unit was at a time.
Pose pose_at(const Track& track, std::int64_t stamp_ns) {
  const double latitude = track.fixes.front().latitude_deg;
  const auto after = std::lower_bound(track.stamps_ns.begin(), track.stamps_ns.end(), stamp_ns);
  const auto next = static_cast<std::size_t>(after - track.stamps_ns.begin());
  if (next == track.fixes.size()) return pose_of(track.fixes.back(), latitude);
  if (next == 0) return pose_of(track.fixes.front(), latitude);
  const auto before = static_cast<double>(stamp_ns - track.stamps_ns[next - 1]);
  const auto whole = static_cast<double>(track.stamps_ns[next] - track.stamps_ns[next - 1]);
  return interpolate(pose_of(track.fixes[next - 1], latitude), pose_of(track.fixes[next], latitude),
                     whole > 0.0 ? before / whole : 1.0);
}

}  // namespace

std::optional<OxtsFix> parse_oxts(std::string_view row) {
  const auto n = numbers_of<6>(row);
  if (!n) return std::nullopt;
  const auto& [latitude, longitude, altitude, roll, pitch, yaw] = *n;
  const bool on_earth = std::abs(latitude) < 89.0 && std::abs(longitude) <= 360.0;
  return on_earth ? std::optional(OxtsFix{latitude, longitude, altitude, roll, pitch, yaw}) : std::nullopt;
}

Pose pose_of(const OxtsFix& fix, double latitude_deg) {
  constexpr double kEarthRadius_m = 6378137.0;
  const double scale = std::cos(deg_to_rad(latitude_deg)) * kEarthRadius_m;
  const double east = scale * deg_to_rad(fix.longitude_deg);
  const double north =
      scale * std::log(std::tan(0.25 * std::numbers::pi + 0.5 * deg_to_rad(fix.latitude_deg)));
  return {from_yaw_pitch_roll(fix.yaw_rad, fix.pitch_rad, fix.roll_rad), {east, north, fix.altitude_m}};
}

std::vector<Pose> find_oxts_poses(const fs::path& scans, std::span<const std::int64_t> stamps_ns,
                                  const InputLimits& limits, const Log& log) {
  std::error_code ignored;
  const fs::path drive = fs::absolute(scans, ignored).lexically_normal().parent_path().parent_path();
  const fs::path oxts = drive / "oxts";
  const fs::path calib = drive.parent_path() / "calib_imu_to_velo.txt";
  if (stamps_ns.empty() || !fs::is_directory(oxts / "data", ignored)) return {};
  const auto T_lidar_imu = read_T_lidar_imu(calib, limits);
  if (!T_lidar_imu) {
    warn(log, fmt::format("{}: not used, since {} (R: and T:) is not there", oxts.string(), calib.string()));
    return {};
  }
  const auto track = read_track(oxts, limits);
  if (!track) {
    warn(log, fmt::format("not used: {}", to_string(track.error())));
    return {};
  }
  const Pose T_imu_lidar = inverse(*T_lidar_imu);
  const Pose T_first_world = inverse(pose_at(*track, stamps_ns.front()) * T_imu_lidar);
  std::vector<Pose> poses;
  for (const std::int64_t stamp : stamps_ns)
    poses.push_back(T_first_world * pose_at(*track, stamp) * T_imu_lidar);
  note(log, fmt::format("{}: {} fixes, turned to the lidar by {}", oxts.string(), track->fixes.size(),
                        calib.string()));
  return poses;
}

}  // namespace verge::io
