// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/fuzz/bag_format.hpp"
#include "verge/io/file/rosbag2.hpp"

namespace verge::fuzz {

std::vector<std::string> seeds() {
  std::vector<std::string> out;
  for (const bool compress : {false, true}) {
    out.push_back(testing::db3_of(seed_messages(io::Wire::kCdr), {.compress = compress}));
  }
  out.push_back(testing::db3_of(velodyne_messages(io::Wire::kCdr)));
  out.push_back(testing::db3_of(seed_messages(io::Wire::kCdr), {.more_sql = "DROP TABLE messages"}));
  return out;
}

void check(Bytes input) { check_recording(input, io::open_db3); }

}  // namespace verge::fuzz
