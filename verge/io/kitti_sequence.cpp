// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/io/kitti_sequence.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <string>
#include <utility>

#include <fmt/core.h>

#include "verge/io/kitti_oxts.hpp"
#include "verge/io/lines.hpp"
#include "verge/io/text.hpp"

namespace verge::io {
namespace fs = std::filesystem;
namespace {

constexpr std::int64_t kSecond = 1'000'000'000;
constexpr std::size_t kMatrix = 12;

/// The folder of the scans and the one above: sequences/00/velodyne, DRIVE/velodyne_points/data.
std::array<fs::path, 2> places_of(const fs::path& scans) {
  std::error_code ignored;
  const fs::path folder = fs::absolute(scans, ignored).lexically_normal();
  const fs::path here = folder.has_filename() ? folder : folder.parent_path();
  return {here, here.parent_path()};
}

std::optional<fs::path> find_file(const fs::path& scans, std::string_view name) {
  for (const fs::path& place : places_of(scans)) {
    std::error_code ignored;
    if (fs::is_regular_file(place / name, ignored)) return place / name;
  }
  return std::nullopt;
}

/// poses.txt, or poses/NN.txt beside sequences/NN/velodyne.
std::optional<fs::path> find_poses(const fs::path& scans) {
  if (auto beside = find_file(scans, "poses.txt")) return beside;
  const fs::path sequence = places_of(scans)[1];
  const fs::path poses =
      sequence.parent_path().parent_path() / "poses" / (sequence.filename().string() + ".txt");
  std::error_code ignored;
  return fs::is_regular_file(poses, ignored) ? std::optional(poses) : std::nullopt;
}

std::optional<Pose> parse_pose(std::string_view line) {
  std::array<double, kMatrix> matrix{};
  WordReader words(line, 1);
  for (double& value : matrix) {
    const auto word = words.next();
    const auto number = word ? parse_number<double>(word->text) : std::nullopt;
    if (!number || !std::isfinite(*number)) return std::nullopt;
    value = *number;
  }
  if (words.next()) return std::nullopt;
  return pose_from_matrix(matrix);
}

/// Tr of calib.txt: T_camera_lidar. Lines that are not Tr count as none.
std::optional<Pose> read_T_camera_lidar(const fs::path& calib, const InputLimits& limits, const Log& log) {
  constexpr std::array<std::string_view, 2> kKeys{"Tr:", "Tr_velo_to_cam:"};
  const auto parse = [&](std::string_view line) -> std::optional<std::optional<Pose>> {
    for (const std::string_view key : kKeys) {
      if (!line.starts_with(key)) continue;
      const auto pose = parse_pose(line.substr(key.size()));
      return pose ? std::optional(std::optional(*pose)) : std::nullopt;
    }
    return std::optional<Pose>();
  };
  const auto lines = read_lines<std::optional<Pose>>(calib, limits, parse);
  if (!lines) {
    warn(log, fmt::format("not used: {}", to_string(lines.error())));
    return std::nullopt;
  }
  for (const auto& pose : *lines) {
    if (pose) return pose;
  }
  warn(log, fmt::format("{}: no Tr, the camera's poses are not used", calib.string()));
  return std::nullopt;
}

std::vector<std::int64_t> find_stamps(const fs::path& scans, const InputLimits& limits, const Log& log) {
  const auto seconds = find_file(scans, "times.txt");
  const auto path = seconds ? seconds : find_file(scans, "timestamps.txt");
  if (!path) return {};
  auto stamps = read_lines<std::int64_t>(*path, limits, seconds ? &parse_seconds : &parse_date_time);
  if (!stamps) {
    warn(log, fmt::format("not used: {}", to_string(stamps.error())));
    return {};
  }
  note(log, fmt::format("{}: {} times", path->string(), stamps->size()));
  return std::move(*stamps);
}

std::vector<Pose> find_sensor_poses(const fs::path& scans, const InputLimits& limits, const Log& log) {
  const auto path = find_poses(scans);
  if (!path) return {};
  const auto calib = find_file(scans, "calib.txt");
  if (!calib) {
    warn(log, fmt::format("{}: not used, since calib.txt (lidar to camera) is not there", path->string()));
    return {};
  }
  const auto T_camera_lidar = read_T_camera_lidar(*calib, limits, log);
  if (!T_camera_lidar) return {};
  auto poses = read_lines<Pose>(*path, limits, &parse_pose);
  if (!poses) {
    warn(log, fmt::format("not used: {}", to_string(poses.error())));
    return {};
  }
  const Pose T_lidar_camera = inverse(*T_camera_lidar);
  for (Pose& pose : *poses) pose = T_lidar_camera * pose * *T_camera_lidar;
  note(log, fmt::format("{}: {} poses, turned to the lidar by {}", path->string(), poses->size(),
                        calib->string()));
  return std::move(*poses);
}

}  // namespace

ScanTrack find_kitti_sequence(const fs::path& scans, const InputLimits& limits, const Log& log) {
  ScanTrack sequence{find_stamps(scans, limits, log), find_sensor_poses(scans, limits, log)};
  if (sequence.T_world_sensor.empty()) {
    sequence.T_world_sensor = find_oxts_poses(scans, sequence.stamps_ns, limits, log);
  }
  const std::size_t times = sequence.stamps_ns.size();
  const std::size_t poses = sequence.T_world_sensor.size();
  if (times > 0 && poses > 0 && times != poses) {
    warn(log, fmt::format("{} times but {} poses: neither is used", times, poses));
    return {};
  }
  if (poses > 0 && times == 0) note(log, "no times beside the poses: 0.1 s between scans is assumed");
  return sequence;
}

std::vector<std::size_t> kitti_rows(const std::vector<fs::path>& files, std::size_t rows) {
  std::vector<std::size_t> numbers;
  for (const fs::path& file : files) {
    const std::string name = file.filename().string();
    const std::string_view stem = std::string_view(name).substr(0, name.find('.'));
    const auto number = parse_number<std::uint64_t>(stem);
    if (!number || *number >= rows) break;
    numbers.push_back(static_cast<std::size_t>(*number));
  }
  if (numbers.size() == files.size()) return numbers;
  if (files.size() != rows) return {};
  numbers.resize(rows);
  for (std::size_t i = 0; i < rows; ++i) numbers[i] = i;
  return numbers;
}

std::optional<std::int64_t> parse_date_time(std::string_view text) {
  // YYYY-MM-DD HH:MM:SS[.fraction]
  constexpr std::string_view kShape = "dddd-dd-dd dd:dd:dd";
  constexpr int kFirstYear = 1970;
  constexpr int kLastYear = 2261;  // 64 bits of nanoseconds end in 2262
  if (text.size() < kShape.size()) return std::nullopt;
  for (std::size_t i = 0; i < kShape.size(); ++i) {
    const bool digit = text[i] >= '0' && text[i] <= '9';
    if (kShape[i] == 'd' ? !digit : text[i] != kShape[i]) return std::nullopt;
  }
  const auto part = [&](std::size_t at, std::size_t length) {
    return parse_number<int>(text.substr(at, length)).value_or(0);
  };
  const std::chrono::year_month_day day{std::chrono::year(part(0, 4)),
                                        std::chrono::month(static_cast<unsigned>(part(5, 2))),
                                        std::chrono::day(static_cast<unsigned>(part(8, 2)))};
  const int hour = part(11, 2);
  const int minute = part(14, 2);
  const int second = part(17, 2);
  const bool in_range = part(0, 4) >= kFirstYear && part(0, 4) <= kLastYear;
  if (!in_range || !day.ok() || hour > 23 || minute > 59 || second > 60) return std::nullopt;
  std::string_view fraction = text.substr(kShape.size());
  std::int64_t nanoseconds = 0;
  if (!fraction.empty()) {
    std::string digits(fraction.substr(1, 9));
    digits.resize(9, '0');
    const auto value = parse_number<std::uint64_t>(digits);
    if (fraction.front() != '.' || fraction.size() < 2 || !value) return std::nullopt;
    nanoseconds = static_cast<std::int64_t>(*value);
  }
  const std::int64_t days = std::chrono::sys_days(day).time_since_epoch().count();
  return (((days * 24 + hour) * 60 + minute) * 60 + second) * kSecond + nanoseconds;
}

}  // namespace verge::io
