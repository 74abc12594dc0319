// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <functional>
#include <numeric>
#include <span>
#include <string>
#include <vector>

#include "verge/core/atomic_file.hpp"
#include "verge/io/file/kitti.hpp"
#include "verge/io/file/nuscenes.hpp"
#include "verge/scan/organise.hpp"

// The two formats without a header, of rows of float32: KITTI's and nuScenes'.

namespace verge::io {
namespace {

/// Row i of the file is what `row` fills in for point order[i] of the scan: so many float32, little-endian.
/// Atomically.
Expected<void> write_float_rows(const std::filesystem::path& path, std::span<const std::uint32_t> order,
                                std::size_t columns,
                                const std::function<void(std::uint32_t, std::span<float>)>& row) {
  auto file = AtomicFile::create(path);
  if (!file) return Unexpected(file.error());
  std::vector<float> values(columns);
  std::string bytes(columns * sizeof(float), '\0');
  for (const std::uint32_t point : order) {
    row(point, values);
    std::memcpy(bytes.data(), values.data(), bytes.size());
    if (auto written = file->write(bytes); !written) return written;
  }
  return file->commit();
}

}  // namespace

std::vector<std::uint32_t> kitti_order(const Scan& scan) {
  const std::vector<std::uint32_t> ring = ring_of_points(scan);
  std::vector<std::uint32_t> order = input_order(scan);
  const auto is_lower = [&](std::uint32_t a, std::uint32_t b) { return ring[a] > ring[b]; };
  if (std::is_sorted(order.begin(), order.end(), is_lower)) return order;
  std::iota(order.begin(), order.end(), 0U);
  std::stable_sort(order.begin(), order.end(), is_lower);
  return order;
}

Expected<void> write_kitti(const std::filesystem::path& path, const Scan& scan) {
  return write_float_rows(path, kitti_order(scan), 4, [&](std::uint32_t i, std::span<float> row) {
    const float intensity = scan.intensity.empty() ? 0.0F : scan.intensity[i];
    const std::array<float, 4> point{scan.x[i], scan.y[i], scan.z[i], intensity};
    std::copy(point.begin(), point.end(), row.begin());
  });
}

Expected<void> write_nuscenes(const std::filesystem::path& path, const Scan& scan) {
  const std::vector<std::uint32_t> ring = ring_of_points(scan);
  return write_float_rows(path, input_order(scan), 5, [&](std::uint32_t i, std::span<float> row) {
    const float intensity = scan.intensity.empty() ? 0.0F : scan.intensity[i];
    const std::array<float, 5> point{-scan.y[i], scan.x[i], scan.z[i], intensity,
                                     static_cast<float>(ring[i])};
    std::copy(point.begin(), point.end(), row.begin());
  });
}

}  // namespace verge::io
