// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/fuzz/bag_format.hpp"
#include "verge/io/file/rosbag1.hpp"

namespace verge::fuzz {

std::vector<std::string> seeds() {
  std::vector<std::string> out;
  for (const char* compression : {"none", "lz4", "bz2"}) {
    for (const bool index : {false, true}) {
      out.push_back(
          testing::rosbag1_of(seed_messages(io::Wire::kRos1), {.compression = compression, .index = index}));
    }
  }
  out.push_back(testing::rosbag1_of(velodyne_messages(io::Wire::kRos1)));
  out.push_back(testing::rosbag1_of(seed_messages(io::Wire::kRos1), {.md5 = "00"}));
  return out;
}

void check(Bytes input) { check_recording(input, io::open_rosbag1); }

}  // namespace verge::fuzz
