// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/scan/test_clouds.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <numbers>
#include <numeric>
#include <random>
#include <sstream>
#include <utility>

#include "verge/core/angle.hpp"

namespace verge::testing {
namespace {

std::string read_file(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::ostringstream bytes;
  bytes << stream.rdbuf();
  return std::move(bytes).str();
}

template <class T>
T value_at(const std::string& bytes, std::size_t offset) {
  T value;
  std::memcpy(&value, bytes.data() + offset, sizeof(T));
  return value;
}

// Distance to flat ground `height` below or to the walls y = -8 and y = 8; 120 m where neither is near.
double reach(double height, double azimuth, double elevation) {
  const double to_ground = elevation < 0.0 ? height / -std::sin(elevation) : 1e9;
  const double sideways = std::fabs(std::sin(azimuth) * std::cos(elevation));
  const double to_wall = sideways > 0.0 ? 8.0 / sideways : 1e9;
  return std::min({to_ground, to_wall, 120.0});
}

template <class T>
void reorder(std::vector<T>& column, const std::vector<std::size_t>& order) {
  if (column.empty()) return;
  std::vector<T> result;
  result.reserve(order.size());
  for (const std::size_t i : order) result.push_back(column[i]);
  column = std::move(result);
}

// Uniform in [0, 1): the library's distributions are not the same everywhere.
double uniform(std::mt19937& random) { return static_cast<double>(random()) / 4294967296.0; }

}  // namespace

SensorPlan plan(std::size_t rings, double lowest_deg, double highest_deg, std::size_t columns) {
  SensorPlan plan;
  plan.columns = columns;
  const double step = rings > 1 ? (highest_deg - lowest_deg) / static_cast<double>(rings - 1) : 0.0;
  for (std::size_t r = 0; r < rings; ++r) {
    plan.elevation_rad.push_back(deg_to_rad(lowest_deg + step * static_cast<double>(r)));
  }
  return plan;
}

Cloud simulate(const SensorPlan& plan, unsigned seed) {
  std::mt19937 random(seed);
  Cloud cloud;
  for (std::size_t r = plan.elevation_rad.size(); r-- > 0;) {
    const double elevation = plan.elevation_rad[r];
    for (std::size_t c = 0; c < plan.columns; ++c) {
      const double t = (static_cast<double>(c) + 0.3 * uniform(random)) / static_cast<double>(plan.columns);
      const double azimuth = (plan.clockwise ? -2.0 : 2.0) * std::numbers::pi * t;
      const double range = reach(plan.height_m, azimuth, elevation) + plan.noise_m * (uniform(random) - 0.5);
      cloud.x.push_back(static_cast<float>(range * std::cos(elevation) * std::cos(azimuth)));
      cloud.y.push_back(static_cast<float>(range * std::cos(elevation) * std::sin(azimuth)));
      cloud.z.push_back(static_cast<float>(range * std::sin(elevation)));
      cloud.intensity.push_back(static_cast<float>(uniform(random)));
      cloud.ring.push_back(static_cast<std::int64_t>(r));
      cloud.time_s.push_back(0.1 * t);
    }
  }
  return cloud;
}

Cloud reordered(const Cloud& cloud, const std::vector<std::size_t>& order) {
  Cloud result = cloud;
  reorder(result.x, order);
  reorder(result.y, order);
  reorder(result.z, order);
  reorder(result.intensity, order);
  reorder(result.ring, order);
  reorder(result.time_s, order);
  reorder(result.echo, order);
  reorder(result.pulse_width, order);
  reorder(result.flags, order);
  reorder(result.label, order);
  return result;
}

Cloud column_major(const Cloud& cloud) {
  std::vector<std::size_t> order(cloud.x.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::vector<std::size_t> column(order.size());
  for (std::size_t i = 0, c = 0; i < column.size(); ++i, ++c) {
    if (i > 0 && cloud.ring[i] != cloud.ring[i - 1]) c = 0;
    column[i] = c;
  }
  std::stable_sort(order.begin(), order.end(),
                   [&column](std::size_t a, std::size_t b) { return column[a] < column[b]; });
  return reordered(cloud, order);
}

Cloud shuffled(const Cloud& cloud, unsigned seed) {
  std::mt19937 random(seed);
  std::vector<std::size_t> order(cloud.x.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  for (std::size_t i = order.size(); i > 1; --i) std::swap(order[i - 1], order[random() % i]);
  return reordered(cloud, order);
}

Cloud turned(const Cloud& cloud, double angle_rad) {
  Cloud result = cloud;
  const double c = std::cos(angle_rad);
  const double s = std::sin(angle_rad);
  for (std::size_t i = 0; i < result.x.size(); ++i) {
    const double x = cloud.x[i];
    const double y = cloud.y[i];
    result.x[i] = static_cast<float>(c * x - s * y);
    result.y[i] = static_cast<float>(s * x + c * y);
  }
  return result;
}

std::optional<std::filesystem::path> data_folder() {
  const char* const folder = std::getenv("VERGE_DATA");
  if (folder == nullptr || *folder == '\0') return std::nullopt;
  return std::filesystem::path(folder);
}

std::vector<std::filesystem::path> files_in(const std::filesystem::path& folder, const std::string& suffix) {
  std::vector<std::filesystem::path> files;
  if (!std::filesystem::is_directory(folder)) return files;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.path().filename().string().ends_with(suffix)) files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

Cloud read_kitti(const std::filesystem::path& file) {
  const std::string bytes = read_file(file);
  Cloud cloud;
  for (std::size_t at = 0; at + 16 <= bytes.size(); at += 16) {
    cloud.x.push_back(value_at<float>(bytes, at));
    cloud.y.push_back(value_at<float>(bytes, at + 4));
    cloud.z.push_back(value_at<float>(bytes, at + 8));
    cloud.intensity.push_back(value_at<float>(bytes, at + 12));
  }
  return cloud;
}

Cloud read_nuscenes(const std::filesystem::path& file) {
  const std::string bytes = read_file(file);
  Cloud cloud;
  for (std::size_t at = 0; at + 20 <= bytes.size(); at += 20) {
    cloud.x.push_back(value_at<float>(bytes, at + 4));
    cloud.y.push_back(-value_at<float>(bytes, at));
    cloud.z.push_back(value_at<float>(bytes, at + 8));
    cloud.intensity.push_back(value_at<float>(bytes, at + 12));
    cloud.ring.push_back(static_cast<std::int64_t>(value_at<float>(bytes, at + 16)));
  }
  return cloud;
}

Cloud read_pcd(const std::filesystem::path& file, std::size_t step, std::optional<std::size_t> ring_at) {
  const std::string bytes = read_file(file);
  const std::string mark = "DATA binary\n";
  const std::size_t header = bytes.find(mark);
  Cloud cloud;
  if (header == std::string::npos) return cloud;
  for (std::size_t at = header + mark.size(); at + step <= bytes.size(); at += step) {
    cloud.x.push_back(value_at<float>(bytes, at));
    cloud.y.push_back(value_at<float>(bytes, at + 4));
    cloud.z.push_back(value_at<float>(bytes, at + 8));
    if (ring_at) cloud.ring.push_back(value_at<std::uint16_t>(bytes, at + *ring_at));
  }
  return cloud;
}

}  // namespace verge::testing
