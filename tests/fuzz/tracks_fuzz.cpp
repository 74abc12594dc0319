// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0

// What data sets store beside their scans: KITTI's times, poses and calibration, the fixes of its raw drives,
// nuScenes' tables.
#include <array>
#include <cmath>
#include <string_view>

#include "tests/fuzz/fuzz.hpp"
#include "tests/fuzz/side_files.hpp"
#include "verge/io/kitti_sequence.hpp"
#include "verge/io/nuscenes_tables.hpp"

namespace verge::fuzz {
namespace {

constexpr char kNextFile = '\x01';
constexpr std::size_t kFiles = 3;

/// The input as up to three files, one behind the other with a byte between.
std::array<std::string_view, kFiles> files_of(std::string_view input) {
  std::array<std::string_view, kFiles> files{};
  for (std::size_t i = 0; i < kFiles; ++i) {
    const std::size_t end = i + 1 < kFiles ? input.find(kNextFile) : std::string_view::npos;
    files[i] = input.substr(0, end);
    if (end == std::string_view::npos) break;
    input.remove_prefix(end + 1);
  }
  return files;
}

std::string input_of(char kind, std::string_view first, std::string_view second, std::string_view third) {
  std::string input(1, kind);
  return input.append(first) + kNextFile + std::string(second) + kNextFile + std::string(third);
}

io::ScanTrack read_kitti(const SideFiles& side, const std::array<std::string_view, kFiles>& files) {
  side.write("kitti/times.txt", files[0]);
  side.write("kitti/poses.txt", files[1]);
  side.write("kitti/calib.txt", files[2]);
  return io::find_kitti_sequence(side.folder() / "kitti" / "velodyne", {}, {});
}

io::ScanTrack read_kitti_raw(const SideFiles& side, const std::array<std::string_view, kFiles>& files) {
  side.write("day/drive/velodyne_points/timestamps.txt", files[0]);
  side.write("day/drive/oxts/timestamps.txt", files[0]);
  side.write("day/drive/oxts/data/0000000000.txt", files[1]);
  side.write("day/calib_imu_to_velo.txt", files[2]);
  return io::find_kitti_sequence(side.folder() / "day" / "drive" / "velodyne_points" / "data", {}, {});
}

io::ScanTrack read_nuscenes(const SideFiles& side, const std::array<std::string_view, kFiles>& files) {
  side.write("nuscenes/v1.0-mini/sample_data.json", files[0]);
  side.write("nuscenes/v1.0-mini/ego_pose.json", files[1]);
  side.write("nuscenes/v1.0-mini/calibrated_sensor.json", files[2]);
  return io::find_nuscenes_track(
      {side.folder() / "nuscenes" / "samples" / "LIDAR_TOP" / "a__LIDAR_TOP__1532402927647951.pcd.bin"}, {});
}

}  // namespace

std::vector<std::string> seeds() {
  const std::string_view matrix = "1 0 0 0.5 0 1 0 0 0 0 1 2e-3\n";
  const std::string_view pose = R"([{"token": "t", "translation": [1, 2, 3.5], "rotation": [1, 0, 0, 0]}])";
  const std::string scan =
      R"([{"token": "s", "filename": "samples/LIDAR_TOP/a__LIDAR_TOP__1532402927647951.pcd.bin",
           "ego_pose_token": "t", "calibrated_sensor_token": "t", "is_key_frame": true, "next": null}])";
  return {input_of('k', "0.0\n1.03e-1\n", std::string(matrix) + std::string(matrix),
                   "P0: 1 2 3\nTr: " + std::string(matrix)),
          input_of('k', "", matrix, "Tr_velo_to_cam: " + std::string(matrix)),
          input_of('k', "1e30\n", "1 0\n", "Tr: 1e308"),
          input_of('r', "2011-09-26 13:02:25.594360375\n", "49.015 8.434 116.4 0.03 0.01 -0.5 1 2 3\n",
                   "R: 1 0 0 0 1 0 0 0 1\nT: -0.8 0.3 -0.8\n"),
          input_of('n', scan, pose, pose),
          input_of('n', scan, "[{", R"([[[{"token": 1e308}]]])")};
}

/// As many times as poses, or one of them not known; nothing that is not finite. The same, read twice.
void check(Bytes input) {
  static const SideFiles side;
  if (input.empty()) return;
  const std::string text(reinterpret_cast<const char*>(input.data()), input.size());
  const auto files = files_of(std::string_view(text).substr(1));
  const auto read = [&] {
    if (text.front() == 'r') return read_kitti_raw(side, files);
    return text.front() == 'n' ? read_nuscenes(side, files) : read_kitti(side, files);
  };
  const io::ScanTrack track = bounded(input, read);
  require(track.stamps_ns.empty() || track.T_world_sensor.empty() ||
          track.stamps_ns.size() == track.T_world_sensor.size());
  for (const Pose& pose : track.T_world_sensor) {
    require(std::isfinite(pose.translation.x) && std::isfinite(pose.translation.y) &&
            std::isfinite(pose.translation.z) && std::isfinite(pose.rotation.w));
  }
  for (std::size_t row = 0; row < track.T_world_sensor.size(); ++row) {
    Scan scan;
    track.attach(scan, row);
    require(!scan.motion || scan.motion->duration_ns > 0);
  }
  require(read().stamps_ns == track.stamps_ns);
}

}  // namespace verge::fuzz
