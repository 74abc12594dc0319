// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

namespace verge::faults {

/// Valid files that the bad ones are made of.

/// The values' bytes, one after the other, as this machine stores them (little-endian).
template <class... T>
[[nodiscard]] std::string packed(T... values) {
  std::string bytes;
  const auto add = [&bytes](auto value) {
    std::string one(sizeof(value), '\0');
    std::memcpy(one.data(), &value, sizeof(value));
    bytes += one;
  };
  (add(values), ...);
  return bytes;
}

/// The bytes of each number of `width` bytes in the other order.
[[nodiscard]] std::string swapped(std::string bytes, std::size_t width = 4);

/// A point of the samples: `rings` rings from the top at 10 m, each counter-clockwise.
struct SamplePoint {
  float x = 0.0F;
  float y = 0.0F;
  float z = 0.0F;
  float intensity = 0.0F;
  std::uint16_t ring = 0;  ///< 0 = the lowest.
};
[[nodiscard]] std::vector<SamplePoint> sample_points(std::size_t rings, std::size_t columns);

[[nodiscard]] std::string kitti(const std::vector<SamplePoint>& points);
/// x right, y forward, with rings.
[[nodiscard]] std::string nuscenes(const std::vector<SamplePoint>& points);

/// Header of a PCD file with x y z intensity (F 4) and ring (U 2), up to and with its DATA line.
[[nodiscard]] std::string pcd_header(std::size_t points, const std::string& data);
[[nodiscard]] std::string pcd_ascii(const std::vector<SamplePoint>& points);
[[nodiscard]] std::string pcd_binary(const std::vector<SamplePoint>& points);
[[nodiscard]] std::string pcd_compressed(const std::vector<SamplePoint>& points);
/// `bytes` as LZF: literals, and copies where the byte before is repeated.
[[nodiscard]] std::string lzf(const std::string& bytes);

/// PLY with a face element before the vertices where `faces`.
[[nodiscard]] std::string ply_ascii(const std::vector<SamplePoint>& points, bool faces);
[[nodiscard]] std::string ply_binary(const std::vector<SamplePoint>& points, bool big_endian, bool faces);

/// Paper 2's table: number, level, distance, x, y, z.
[[nodiscard]] std::string csv(const std::vector<SamplePoint>& points, bool header);

/// LAS 1.MINOR of a point format.
[[nodiscard]] std::string las(const std::vector<SamplePoint>& points, int minor, std::uint8_t format);

/// A valid file of every format and kind of data.
struct Sample {
  std::string file;
  std::string bytes;
  std::size_t header = 0;  ///< Bytes of text at its beginning that describe the rest.
};
[[nodiscard]] std::vector<Sample> samples(std::size_t rings, std::size_t columns);

}  // namespace verge::faults
