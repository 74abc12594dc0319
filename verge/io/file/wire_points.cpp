// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/io/file/wire_points.hpp"

namespace verge::io {

Cloud wire_points(const Scan& scan) {
  Cloud cloud = flatten(scan);
  cloud.time_s.clear();  // absolute seconds are too coarse in a double
  if (scan.time_offset_ns.empty()) return cloud;
  cloud.time_s.reserve(scan.size());
  for (const std::uint32_t i : input_order(scan)) cloud.time_s.push_back(1e-9 * scan.time_offset_ns[i]);
  return cloud;
}

std::int64_t ScanTimes::of(const Scan& scan) {
  constexpr std::int64_t kStepNs = 100'000'000;
  const std::int64_t time_ns = scan.stamp_ns.value_or(next_ns_);
  next_ns_ = time_ns + kStepNs;
  return time_ns;
}

}  // namespace verge::io
