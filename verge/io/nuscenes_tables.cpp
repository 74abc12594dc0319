// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/io/nuscenes_tables.hpp"

#include <array>
#include <fstream>
#include <functional>
#include <map>
#include <numbers>
#include <string>
#include <system_error>
#include <utility>

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include "verge/io/sniff.hpp"
#include "verge/io/text.hpp"

namespace verge::io {
namespace fs = std::filesystem;
namespace {

using Json = nlohmann::json;

/// The texts and number lists of one row of a table; everything else in it is passed over.
struct Row {
  std::map<std::string, std::string> texts;
  std::map<std::string, std::vector<double>> numbers;
};

/// Calls `row` for each object of a JSON list of flat objects, one in memory at a time.
class RowReader final : public nlohmann::json_sax<Json> {
 public:
  explicit RowReader(std::function<void(const Row&)> row) : row_(std::move(row)) {}

  bool null() override { return true; }
  bool boolean(bool /*value*/) override { return true; }
  bool number_integer(std::int64_t value) override { return number(static_cast<double>(value)); }
  bool number_unsigned(std::uint64_t value) override { return number(static_cast<double>(value)); }
  bool number_float(double value, const std::string& /*text*/) override { return number(value); }
  bool string(std::string& value) override {
    if (depth_ == kInRow) current_.texts[key_] = std::move(value);
    return true;
  }
  bool binary(Json::binary_t& /*value*/) override { return false; }
  bool start_object(std::size_t /*size*/) override { return enter(); }
  bool start_array(std::size_t /*size*/) override { return enter(); }
  bool end_array() override {
    --depth_;
    return true;
  }
  bool end_object() override {
    if (depth_ == kInRow) row_(std::exchange(current_, {}));
    --depth_;
    return true;
  }
  bool key(std::string& value) override {
    if (depth_ == kInRow) key_ = std::move(value);
    return true;
  }
  bool parse_error(std::size_t position, const std::string& /*token*/,
                   const nlohmann::detail::exception& /*error*/) override {
    error_at_ = position;
    return false;
  }

  [[nodiscard]] std::size_t error_at() const { return error_at_; }

 private:
  static constexpr int kInRow = 2;  // the list, and an object in it
  static constexpr int kDeepest = 32;
  static constexpr std::size_t kMostNumbers = 16;

  bool enter() { return ++depth_ <= kDeepest; }
  bool number(double value) {
    auto& list = current_.numbers[key_];
    if (list.size() < kMostNumbers) list.push_back(value);
    return true;
  }

  std::function<void(const Row&)> row_;
  Row current_;
  std::string key_;
  int depth_ = 0;
  std::size_t error_at_ = 0;
};

Expected<void> read_table(const fs::path& path, const std::function<void(const Row&)>& row) {
  std::ifstream in(path, std::ios::binary);
  if (!in) return Unexpected({ErrorCode::kCannotOpen, path.string(), {}, "cannot open", {}, {}});
  RowReader reader(row);
  if (Json::sax_parse(in, &reader)) return {};
  return Unexpected({ErrorCode::kUnusable,
                     path.string(),
                     fmt::format("{}", reader.error_at()),
                     "is no JSON list of objects",
                     {},
                     {}});
}

std::string text_of(const Row& row, const std::string& key) {
  const auto found = row.texts.find(key);
  return found == row.texts.end() ? std::string() : found->second;
}

/// translation [x, y, z] and rotation [w, x, y, z] of a row.
std::optional<Pose> pose_of(const Row& row) {
  const auto t = row.numbers.find("translation");
  const auto q = row.numbers.find("rotation");
  if (t == row.numbers.end() || q == row.numbers.end() || t->second.size() != 3 || q->second.size() != 4) {
    return std::nullopt;
  }
  const Quaternion rotation{q->second[0], q->second[1], q->second[2], q->second[3]};
  const double norm_squared =
      rotation.w * rotation.w + rotation.x * rotation.x + rotation.y * rotation.y + rotation.z * rotation.z;
  constexpr double kOff = 1e-3;
  if (!(norm_squared > 1.0 - kOff && norm_squared < 1.0 + kOff)) return std::nullopt;
  return Pose{rotation, {t->second[0], t->second[1], t->second[2]}};
}

/// Which rows of the other tables belong to a scan.
struct Tokens {
  std::string ego_pose;
  std::string calibrated_sensor;
};

Expected<std::map<std::string, Tokens>> read_tokens(const fs::path& tables,
                                                    const std::vector<fs::path>& files) {
  std::map<std::string, Tokens> tokens;
  for (const fs::path& file : files) tokens[file.filename().string()] = {};
  const auto read = read_table(tables / "sample_data.json", [&](const Row& row) {
    const auto scan = tokens.find(fs::path(text_of(row, "filename")).filename().string());
    if (scan != tokens.end())
      scan->second = {text_of(row, "ego_pose_token"), text_of(row, "calibrated_sensor_token")};
  });
  if (!read) return Unexpected(read.error());
  return tokens;
}

/// The poses of the rows with these tokens; the keys of `wanted`.
Expected<void> read_poses(const fs::path& table, std::map<std::string, std::optional<Pose>>& wanted) {
  return read_table(table, [&](const Row& row) {
    const auto found = wanted.find(text_of(row, "token"));
    if (found != wanted.end()) found->second = pose_of(row);
  });
}

/// A point of ours (x forward, y left) in nuScenes' lidar frame (x right, y forward).
Pose T_lidar_ours() { return {from_yaw_pitch_roll(0.5 * std::numbers::pi, 0.0, 0.0), {}}; }

Expected<std::vector<Pose>> read_sensor_poses(const fs::path& tables, const std::vector<fs::path>& files) {
  const auto tokens = read_tokens(tables, files);
  if (!tokens) return Unexpected(tokens.error());
  std::map<std::string, std::optional<Pose>> ego;
  std::map<std::string, std::optional<Pose>> mounted;
  for (const auto& [name, token] : *tokens) {
    ego[token.ego_pose] = std::nullopt;
    mounted[token.calibrated_sensor] = std::nullopt;
  }
  if (auto read = read_poses(tables / "ego_pose.json", ego); !read) return Unexpected(read.error());
  if (auto read = read_poses(tables / "calibrated_sensor.json", mounted); !read)
    return Unexpected(read.error());
  std::vector<Pose> poses;
  for (const fs::path& file : files) {
    const Tokens& token = tokens->at(file.filename().string());
    const auto& T_world_ego = ego[token.ego_pose];
    const auto& T_ego_lidar = mounted[token.calibrated_sensor];
    if (!T_world_ego || !T_ego_lidar) {
      return Unexpected({ErrorCode::kUnusable,
                         tables.string(),
                         {},
                         fmt::format("no pose of {}", file.filename().string()),
                         {},
                         {}});
    }
    poses.push_back(*T_world_ego * *T_ego_lidar * T_lidar_ours());
  }
  return poses;
}

/// ROOT/v1.0-* of ROOT/samples/LIDAR_TOP.
std::optional<fs::path> find_tables(const fs::path& scans) {
  std::error_code error;
  const fs::path root = fs::absolute(scans, error).lexically_normal().parent_path().parent_path();
  std::optional<fs::path> first;
  for (fs::directory_iterator entry(root, error), end; !error && entry != end; entry.increment(error)) {
    const bool named = entry->path().filename().string().starts_with("v1.0");
    std::error_code ignored;
    if (!named || !fs::is_regular_file(entry->path() / "sample_data.json", ignored)) continue;
    if (!first || entry->path() < *first) first = entry->path();
  }
  return first;
}

}  // namespace

std::optional<std::int64_t> nuscenes_stamp_ns(const fs::path& file) {
  constexpr std::int64_t kMicrosecond = 1'000;
  constexpr std::int64_t kLatest = 9'200'000'000'000'000;
  const std::string name = frame_name(file);
  const std::size_t at = name.rfind("__");
  if (at == std::string::npos) return std::nullopt;
  const auto microseconds = parse_number<std::int64_t>(std::string_view(name).substr(at + 2));
  if (!microseconds || *microseconds < 0 || *microseconds > kLatest) return std::nullopt;
  return *microseconds * kMicrosecond;
}

ScanTrack find_nuscenes_track(const std::vector<fs::path>& files, const Log& log) {
  ScanTrack track;
  for (const fs::path& file : files) {
    const auto stamp = nuscenes_stamp_ns(file);
    if (!stamp) return {};
    track.stamps_ns.push_back(*stamp);
  }
  if (files.empty()) return track;
  const auto tables = find_tables(files.front().parent_path());
  if (!tables) return track;
  auto poses = read_sensor_poses(*tables, files);
  if (!poses) {
    warn(log, fmt::format("not used: {}", to_string(poses.error())));
    return track;
  }
  note(log, fmt::format("{}: {} poses", tables->string(), poses->size()));
  track.T_world_sensor = *std::move(poses);
  return track;
}

}  // namespace verge::io
