// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include <cstring>

#include "tests/fuzz/fuzz.hpp"
#include "verge/io/file/las.hpp"
#include "verge/io/file/test_las.hpp"

namespace verge::fuzz {
namespace {

/// A file of three points far from 0 with `vlr_bytes` in one variable length record.
std::string las(int minor, std::uint8_t format, std::uint16_t vlr_bytes) {
  return testing::LasFile(minor, format, 3, testing::vlr("", 0, vlr_bytes, vlr_bytes))
      .put(6, std::uint16_t{1})
      .put(100, 1U)
      .put(107, 3U)
      .put(155, 691'000.0)
      .bytes();
}

}  // namespace

std::vector<std::string> seeds() {
  std::vector<std::string> seeds;
  for (int minor = 0; minor <= 4; ++minor) {
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
