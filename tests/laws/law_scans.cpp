// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/laws/law_scans.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "verge/core/polyline.hpp"
#include "verge/io/source.hpp"
#include "verge/scan/test_clouds.hpp"
#include "verge/sim/drive.hpp"
#include "verge/sim/ready.hpp"

namespace verge::laws {
namespace {

Subject simulated(const std::string& name, const sim::Scenario& scenario, std::uint64_t index) {
  sim::DriveConfig config;
  config.scenario = scenario;
  return {name, flatten(deskew(sim::Drive(config).scan(index).scan))};
}

void add_files(std::vector<Subject>& subjects, const std::filesystem::path& folder, const std::string& suffix,
               std::size_t count) {
  const auto files = testing::files_in(folder, suffix);
  const std::size_t wanted = std::min(count, files.size());
  for (std::size_t k = 0; k < wanted; ++k) {
    const auto& file = files[k * files.size() / wanted];
    const auto source = io::open(file);
    if (!source) continue;
    const auto scan = (*source)->next();
    if (scan && *scan) subjects.push_back({file.string(), flatten(**scan)});
  }
}

template <class Move>
Scene moved(Scene scene, const Move& move) {
  for (Boundary& boundary : scene.boundaries) {
    std::transform(boundary.points.begin(), boundary.points.end(), boundary.points.begin(), move);
  }
  return scene;
}

// Distance of p from the nearest boundary of that side; infinity where there is none.
double distance_to_side(const Scene& scene, Side side, Vec2 p) {
  double least = std::numeric_limits<double>::infinity();
  for (const Boundary& boundary : scene.boundaries) {
    if (boundary.side != side) continue;
    std::vector<Vec2> line;
    for (const Vec3& vertex : boundary.points) line.push_back(vertex.xy());
    least = std::min(least, distance_to(line, p));
  }
  return least;
}

}  // namespace

std::vector<Subject> simulated_subjects() {
  sim::Scenario crabwise = sim::ready_scenario("straight");
  crabwise.course.crab_deg = 4.6;
  crabwise.course.lateral_m = -1.5;
  return {simulated("straight", sim::ready_scenario("straight"), 0), simulated("crabwise", crabwise, 0),
          simulated("curve", sim::ready_scenario("curve"), 0),
          simulated("street", sim::ready_scenario("street"), 20)};
}

std::vector<Subject> real_subjects(const std::filesystem::path& data, std::size_t count) {
  std::vector<Subject> subjects;
  add_files(subjects, data / "nuscenes-hdl32/labelled/LIDAR_TOP", ".pcd.bin", count);
  add_files(subjects, data / "semantickitti/sequences/00/velodyne", ".bin", count);
  add_files(subjects, data / "vlp16-kerb-labels", ".pcd", count);
  return subjects;
}

Cloud mirrored_left_right(const Cloud& cloud) {
  Cloud result = cloud;
  for (float& y : result.y) y = -y;
  return result;
}

Cloud mirrored_front_back(const Cloud& cloud) {
  Cloud result = cloud;
  for (float& x : result.x) x = -x;
  return result;
}

Cloud with_ceiling(const Cloud& cloud, const Mount& mount, double height_m) {
  constexpr int kColumns = 720;
  const LevelFrame level(mount);
  Cloud result = cloud;
  const std::int64_t top = *std::max_element(cloud.ring.begin(), cloud.ring.end());
  for (std::int64_t ring = 1; ring <= 3; ++ring) {
    const double reach = 12.0 / static_cast<double>(ring);
    for (int c = 0; c < kColumns; ++c) {
      const double azimuth = 2.0 * std::numbers::pi * (c + 0.5) / kColumns;
      const Vec3 p = level.to_sensor({reach * std::cos(azimuth), reach * std::sin(azimuth), height_m});
      result.x.push_back(static_cast<float>(p.x));
      result.y.push_back(static_cast<float>(p.y));
      result.z.push_back(static_cast<float>(p.z));
      result.ring.push_back(top + ring);
    }
  }
  const std::size_t n = result.x.size();
  if (!result.intensity.empty()) result.intensity.resize(n);
  if (!result.time_s.empty()) result.time_s.resize(n, result.time_s.front());
  if (!result.label.empty()) result.label.resize(n);
  return result;
}

Scene mirrored_left_right(Scene scene) {
  scene = moved(std::move(scene), [](Vec3 p) { return Vec3{p.x, -p.y, p.z}; });
  for (Boundary& boundary : scene.boundaries) {
    if (boundary.side == Side::kLeft) {
      boundary.side = Side::kRight;
    } else if (boundary.side == Side::kRight) {
      boundary.side = Side::kLeft;
    }
  }
  return scene;
}

Scene mirrored_front_back(Scene scene) {
  return moved(std::move(scene), [](Vec3 p) { return Vec3{-p.x, p.y, p.z}; });
}

Scene turned(Scene scene, double angle_rad) {
  const Quaternion turn = from_yaw_pitch_roll(angle_rad, 0.0, 0.0);
  return moved(std::move(scene), [&turn](Vec3 p) { return rotate(turn, p); });
}

Agreement agreement(const Scene& a, const Scene& b, double tolerance_m) {
  Agreement result;
  for (const auto& [from, to] : {std::pair(&a, &b), std::pair(&b, &a)}) {
    for (const Boundary& boundary : from->boundaries) {
      for (const Vec3& vertex : boundary.points) {
        ++result.vertices;
        if (distance_to_side(*to, boundary.side, vertex.xy()) < tolerance_m) ++result.near;
      }
    }
  }
  return result;
}

}  // namespace verge::laws
