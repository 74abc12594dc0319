// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/fuzz/bag_format.hpp"
#include "verge/io/file/mcap.hpp"

namespace verge::fuzz {

std::vector<std::string> seeds() {
  std::vector<std::string> out;
  for (const io::Packing packing : {io::Packing::kNone, io::Packing::kLz4, io::Packing::kZstd}) {
    for (const std::size_t messages_per_chunk : {0U, 1U, 3U}) {
      for (const bool closed : {false, true}) {
        out.push_back(
            testing::mcap_of(seed_messages(io::Wire::kCdr), {.packing = packing,
                                                             .messages_per_chunk = messages_per_chunk,
                                                             .summary = closed,
                                                             .footer = closed,
                                                             .checksums = false}));
      }
    }
  }
  out.push_back(testing::mcap_of(seed_messages(io::Wire::kRos1), {.encoding = "ros1"}));
  out.push_back(testing::mcap_of(velodyne_messages(io::Wire::kCdr)));
  return out;
}

void check(Bytes input) { check_recording(input, io::open_mcap); }

}  // namespace verge::fuzz
