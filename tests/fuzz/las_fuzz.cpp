// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include <cstring>

#include "tests/fuzz/fuzz.hpp"
#include "verge/io/file/las.hpp"
#include "verge/io/file/las_header.hpp"

namespace verge::fuzz {
namespace {

/// A file of three points with `vlr_bytes` in one variable length record.
std::string las(std::uint8_t minor, std::uint8_t format, std::uint16_t vlr_bytes) {
  const std::size_t header = minor == 4 ? 375 : minor == 3 ? 235 : 227;
  const std::size_t points_at = header + 54 + vlr_bytes;
  std::string bytes(points_at + std::size_t{3} * io::las_record_bytes(format), '\0');
  const auto put = [&](std::size_t at, auto value) { std::memcpy(bytes.data() + at, &value, sizeof(value)); };
  bytes.replace(0, 4, "LASF");
  put(6, std::uint16_t{1});
  put(24, std::uint8_t{1});
  put(25, minor);
  put(94, static_cast<std::uint16_t>(header));
  put(96, static_cast<std::uint32_t>(points_at));
  put(100, 1U);
  put(104, format);
  put(105, io::las_record_bytes(format));
  put(107, 3U);
  if (minor == 4) put(247, std::uint64_t{3});
  for (std::size_t axis = 0; axis < 3; ++axis) put(131 + 8 * axis, 0.01);
  put(155, 691'000.0);
  put(header + 20, vlr_bytes);
  put(points_at, 12345);
  return bytes;
}

}  // namespace

std::vector<std::string> seeds() {
  std::vector<std::string> seeds;
  for (const std::uint8_t minor : {std::uint8_t{2}, std::uint8_t{3}, std::uint8_t{4}}) {
    for (std::uint8_t format = 0; format <= 10; ++format) {
      seeds.push_back(las(minor, format, static_cast<std::uint16_t>(7 * format)));
    }
  }
  return seeds;
}

/// Decoded twice it is the same, with no more points than the file has room for, and times that begin at 0.
void check(Bytes input) {
  const auto decode = [&] {
    io::Input file = io::Input::of(input, "fuzz");
    return io::read_las(file);
  };
  const auto once = bounded(input, decode);
  const auto again = bounded(input, decode);
  require(once.has_value() == again.has_value());
  if (!once) {
    require(!once.error().what.empty() && to_string(once.error()) == to_string(again.error()));
    return;
  }
  const Cloud& cloud = once->cloud;
  require(cloud.x.size() <= input.size() / 20);
  require(cloud.y.size() == cloud.x.size() && cloud.z.size() == cloud.x.size());
  require(cloud.time_s.empty() || cloud.time_s.size() == cloud.x.size());
  for (const double time : cloud.time_s) require(time >= 0.0);
  const auto same = [](const std::vector<float>& a, const std::vector<float>& b) {
    return a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(float)) == 0;  // NaN too
  };
  require(again->cloud.x.size() == cloud.x.size() && same(cloud.x, again->cloud.x) &&
          once->notes == again->notes);
}

}  // namespace verge::fuzz
