// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/faults/samples.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "verge/io/file/test_las.hpp"

namespace verge::faults {
namespace {

std::string text(float value) { return std::to_string(value); }

std::string in_order(std::string bytes, bool big_endian) {
  if (big_endian) std::reverse(bytes.begin(), bytes.end());
  return bytes;
}

}  // namespace

std::string swapped(std::string bytes, std::size_t width) {
  for (std::size_t i = 0; i + width <= bytes.size(); i += width) {
    const auto begin = bytes.begin() + static_cast<std::ptrdiff_t>(i);
    std::reverse(begin, begin + static_cast<std::ptrdiff_t>(width));
  }
  return bytes;
}

std::vector<SamplePoint> sample_points(std::size_t rings, std::size_t columns) {
  std::vector<SamplePoint> points;
  for (std::size_t r = 0; r < rings; ++r) {
    const double elevation = 0.05 - 0.02 * static_cast<double>(r);
    for (std::size_t c = 0; c < columns; ++c) {
      const double azimuth =
          2.0 * std::numbers::pi * (static_cast<double>(c) + 0.5) / static_cast<double>(columns);
      points.push_back({static_cast<float>(10.0 * std::cos(azimuth) * std::cos(elevation)),
                        static_cast<float>(10.0 * std::sin(azimuth) * std::cos(elevation)),
                        static_cast<float>(10.0 * std::sin(elevation)), static_cast<float>(c % 4) * 0.25F,
                        static_cast<std::uint16_t>(rings - 1 - r)});
    }
  }
  return points;
}

std::string kitti(const std::vector<SamplePoint>& points) {
  std::string bytes;
  for (const SamplePoint& p : points) bytes += packed(p.x, p.y, p.z, p.intensity);
  return bytes;
}

std::string nuscenes(const std::vector<SamplePoint>& points) {
  std::string bytes;
  for (const SamplePoint& p : points)
    bytes += packed(-p.y, p.x, p.z, p.intensity * 255, static_cast<float>(p.ring));
  return bytes;
}

std::string pcd_header(std::size_t points, const std::string& data) {
  const std::string n = std::to_string(points);
  return "# .PCD v0.7 - Point Cloud Data file format\nVERSION 0.7\nFIELDS x y z intensity ring\nSIZE 4 4 4 4 "
         "2\n"
         "TYPE F F F F U\nCOUNT 1 1 1 1 1\nWIDTH " +
         n + "\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS " + n + "\nDATA " + data + "\n";
}

std::string pcd_ascii(const std::vector<SamplePoint>& points) {
  std::string bytes = pcd_header(points.size(), "ascii");
  for (const SamplePoint& p : points) {
    bytes += text(p.x) + " " + text(p.y) + " " + text(p.z) + " " + text(p.intensity) + " " +
             std::to_string(p.ring) + "\n";
  }
  return bytes;
}

std::string pcd_binary(const std::vector<SamplePoint>& points) {
  std::string bytes = pcd_header(points.size(), "binary");
  for (const SamplePoint& p : points) bytes += packed(p.x, p.y, p.z, p.intensity, p.ring);
  return bytes;
}

std::string lzf(const std::string& bytes) {
  std::string out;
  std::size_t at = 0;
  while (at < bytes.size()) {
    std::size_t run = 0;
    while (at > 0 && at + run < bytes.size() && run < 264 && bytes[at + run] == bytes[at - 1]) ++run;
    if (run >= 3) {
      const std::size_t length = run - 2;
      out += static_cast<char>(std::min<std::size_t>(length, 7) << 5U);
      if (length >= 7) out += static_cast<char>(length - 7);
      out += '\0';
      at += run;
      continue;
    }
    const std::size_t count = std::min<std::size_t>(4, bytes.size() - at);
    out += static_cast<char>(count - 1) + bytes.substr(at, count);
    at += count;
  }
  return out;
}

std::string pcd_compressed(const std::vector<SamplePoint>& points) {
  std::string columns;
  for (float SamplePoint::*field :
       {&SamplePoint::x, &SamplePoint::y, &SamplePoint::z, &SamplePoint::intensity}) {
    for (const SamplePoint& p : points) columns += packed(p.*field);
  }
  for (const SamplePoint& p : points) columns += packed(p.ring);
  const std::string data = lzf(columns);
  return pcd_header(points.size(), "binary_compressed") +
         packed(static_cast<std::uint32_t>(data.size()), static_cast<std::uint32_t>(columns.size())) + data;
}

std::string ply_ascii(const std::vector<SamplePoint>& points, bool faces) {
  std::string bytes = "ply\nformat ascii 1.0\ncomment a sample\n";
  if (faces) bytes += "element face 2\nproperty list uchar int vertex_indices\n";
  bytes += "element vertex " + std::to_string(points.size()) +
           "\nproperty float x\nproperty float y\nproperty float z\nproperty float intensity\nproperty uchar "
           "ring\nend_header\n";
  if (faces) bytes += "3 0 1 2\n3 1 2 3\n";
  for (const SamplePoint& p : points) {
    bytes += text(p.x) + " " + text(p.y) + " " + text(p.z) + " " + text(p.intensity) + " " +
             std::to_string(p.ring) + "\n";
  }
  return bytes;
}

std::string ply_binary(const std::vector<SamplePoint>& points, bool big_endian, bool faces) {
  std::string bytes = std::string("ply\nformat binary_") + (big_endian ? "big" : "little") + "_endian 1.0\n";
  if (faces) bytes += "element face 2\nproperty list uchar int vertex_indices\n";
  bytes += "element vertex " + std::to_string(points.size()) +
           "\nproperty float x\nproperty float y\nproperty float z\nproperty double intensity\nproperty "
           "ushort ring\n"
           "end_header\n";
  const auto put = [&](auto value) { bytes += in_order(packed(value), big_endian); };
  for (int face = 0; face < (faces ? 2 : 0); ++face) {
    put(std::uint8_t{3});
    for (int i = 0; i < 3; ++i) put(face + i);
  }
  for (const SamplePoint& p : points) {
    for (const float value : {p.x, p.y, p.z}) put(value);
    put(static_cast<double>(p.intensity));
    put(p.ring);
  }
  return bytes;
}

std::string csv(const std::vector<SamplePoint>& points, bool header) {
  std::string bytes = header ? "number,level,distance,x,y,z\n" : "";
  for (std::size_t i = 0; i < points.size(); ++i) {
    const SamplePoint& p = points[i];
    bytes += std::to_string(i) + "," + std::to_string(p.ring) + "," + text(std::hypot(p.x, p.y, p.z)) + "," +
             text(p.x) + "," + text(p.y) + "," + text(p.z) + "\n";
  }
  return bytes;
}

std::string las(const std::vector<SamplePoint>& points, int minor, std::uint8_t format) {
  testing::LasFile out(minor, format, points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const SamplePoint& p = points[i];
    out.place(i, static_cast<double>(p.x), static_cast<double>(p.y), static_cast<double>(p.z));
  }
  return out.bytes();
}

std::vector<Sample> samples(std::size_t rings, std::size_t columns) {
  const std::vector<SamplePoint> points = sample_points(rings, columns);
  std::vector<Sample> all{{"kitti.bin", kitti(points)},
                          {"nuscenes.pcd.bin", nuscenes(points)},
                          {"ascii.pcd", pcd_ascii(points)},
                          {"binary.pcd", pcd_binary(points)},
                          {"compressed.pcd", pcd_compressed(points)},
                          {"ascii.ply", ply_ascii(points, false)},
                          {"ascii_faces.ply", ply_ascii(points, true)},
                          {"little.ply", ply_binary(points, false, false)},
                          {"little_faces.ply", ply_binary(points, false, true)},
                          {"big_faces.ply", ply_binary(points, true, true)},
                          {"header.csv", csv(points, true)},
                          {"plain.csv", csv(points, false)},
                          {"first.las", las(points, 2, 1)},
                          {"latest.las", las(points, 4, 7)}};
  for (Sample& sample : all) {
    for (const char* last : {"end_header\n", "DATA ascii\n", "DATA binary\n", "DATA binary_compressed\n"}) {
      const std::size_t found = sample.bytes.find(last);
      if (found != std::string::npos) sample.header = found + std::strlen(last);
    }
  }
  return all;
}

}  // namespace verge::faults
