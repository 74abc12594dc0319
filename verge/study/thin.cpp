// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/study/thin.hpp"

#include <cstddef>
#include <vector>

#include "verge/sim/noise.hpp"

namespace verge::study {
namespace {

/// A column without the points that go; one that the scan does not have stays empty.
template <class Value>
void keep_only(std::vector<Value>& column, const std::vector<bool>& kept) {
  if (column.empty()) return;
  std::size_t count = 0;
  for (std::size_t i = 0; i < kept.size(); ++i) {
    if (kept[i]) column[count++] = column[i];
  }
  column.resize(count);
}

void move_rings(std::vector<std::uint32_t>& ring_begin, const std::vector<bool>& kept) {
  std::uint32_t before = 0;
  std::size_t i = 0;
  for (std::uint32_t& begin : ring_begin) {
    for (; i < begin; ++i) before += kept[i] ? 1U : 0U;
    begin = before;
  }
}

}  // namespace

Scan thin(Scan scan, double share, std::uint64_t seed, std::uint64_t index) {
  if (share <= 0.0) return scan;
  std::vector<bool> kept(scan.size());
  for (std::size_t i = 0; i < kept.size(); ++i) {
    // Another seed than the drive's: these draws are not those of its noise.
    const sim::RayKey key{~seed, index, scan.input_index[i]};
    kept[i] = sim::uniform(key, sim::Draw::kDropout) >= share;
  }
  keep_only(scan.azimuth, kept);
  keep_only(scan.range, kept);
  keep_only(scan.x, kept);
  keep_only(scan.y, kept);
  keep_only(scan.z, kept);
  keep_only(scan.intensity, kept);
  keep_only(scan.time_offset_ns, kept);
  keep_only(scan.echo, kept);
  keep_only(scan.pulse_width, kept);
  keep_only(scan.flags, kept);
  keep_only(scan.label, kept);
  keep_only(scan.input_index, kept);
  move_rings(scan.ring_begin, kept);
  return scan;
}

}  // namespace verge::study
