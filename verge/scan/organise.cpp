// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/scan/organise.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <tuple>
#include <utility>

#include <fmt/format.h>

#include "verge/scan/ring_order.hpp"
#include "verge/scan/rings.hpp"

namespace verge {
namespace {

constexpr float kRangeMax = 1e5F;

// Which points to keep: those that are finite and not too far away. (The range of a point with a NaN is NaN,
// and compares false.)
std::vector<std::uint32_t> usable_points(const Scan& scan) {
  std::vector<std::uint32_t> kept(scan.size());
  std::iota(kept.begin(), kept.end(), 0U);
  std::size_t unusable = 0;
  for (const float range : scan.range) unusable += range <= kRangeMax ? 0U : 1U;
  if (unusable > 0) std::erase_if(kept, [&scan](std::uint32_t i) { return !(scan.range[i] <= kRangeMax); });
  return kept;
}

template <class T>
std::vector<T> gather(const std::vector<T>& column, const std::vector<std::uint32_t>& order) {
  if (column.empty()) return {};
  std::vector<T> gathered(order.size());
  std::transform(order.begin(), order.end(), gathered.begin(),
                 [&column](std::uint32_t i) { return column[i]; });
  return gathered;
}

// Leaves out what cannot be used, in every column, and remembers which points stayed.
void drop_unusable(Scan& scan, Cloud& cloud) {
  std::vector<std::uint32_t> kept = usable_points(scan);
  scan.dropped = scan.size() - kept.size();
  if (scan.dropped > 0) {
    permute_points(scan, kept);
    cloud.ring = gather(cloud.ring, kept);
    cloud.time_s = gather(cloud.time_s, kept);
  }
  scan.input_index = std::move(kept);
}

// Fills stamp and offsets. False where the times cannot be those of one scan: not finite, or more than the
// 4.29 s apart that an offset can say.
bool set_times(Scan& scan, const std::vector<double>& time_s) {
  if (time_s.empty()) return true;
  constexpr double kAbsoluteMin = 1e8;  // seconds: March 1973; relative times are far below
  constexpr double kAbsoluteMax = 9e9;  // beyond it nanoseconds do not fit
  const auto [first, last] = std::minmax_element(time_s.begin(), time_s.end());
  const double begin = *first;
  const bool finite = std::all_of(time_s.begin(), time_s.end(), [](double t) { return std::isfinite(t); });
  if (!finite || begin > kAbsoluteMax || (*last - begin) * 1e9 > std::numeric_limits<std::uint32_t>::max()) {
    return false;
  }
  if (begin > kAbsoluteMin) scan.stamp_ns = std::llround(begin * 1e9);
  scan.time_offset_ns.resize(time_s.size());
  std::transform(time_s.begin(), time_s.end(), scan.time_offset_ns.begin(),
                 [begin](double t) { return static_cast<std::uint32_t>(std::llround((t - begin) * 1e9)); });
  return true;
}

// Takes the cloud's columns, but for the field of rings and the times, into a scan without order.
Scan take_columns(Cloud& cloud) {
  Scan scan;
  scan.x = std::move(cloud.x);
  scan.y = std::move(cloud.y);
  scan.z = std::move(cloud.z);
  scan.intensity = std::move(cloud.intensity);
  scan.echo = std::move(cloud.echo);
  scan.pulse_width = std::move(cloud.pulse_width);
  scan.flags = std::move(cloud.flags);
  scan.label = std::move(cloud.label);
  measure_directions(scan);
  return scan;
}

// Indices of the points ring by ring (counting sort), and where each ring begins.
struct Grouped {
  std::vector<std::uint32_t> order;
  std::vector<std::uint32_t> begin;
};

Grouped group(const RingNumbers& rings) {
  Grouped grouped{.order = std::vector<std::uint32_t>(rings.ring_of.size()),
                  .begin = std::vector<std::uint32_t>(rings.count + 1, 0)};
  for (const std::uint32_t ring : rings.ring_of) ++grouped.begin[ring + 1];
  std::partial_sum(grouped.begin.begin(), grouped.begin.end(), grouped.begin.begin());
  std::vector<std::uint32_t> next(grouped.begin.begin(), grouped.begin.end() - 1);
  for (std::uint32_t i = 0; i < rings.ring_of.size(); ++i) grouped.order[next[rings.ring_of[i]]++] = i;
  return grouped;
}

// Sine of the median elevation of up to 255 returns spread evenly over a ring; none where nothing came back.
std::optional<float> elevation_of(const Scan& scan, std::span<const std::uint32_t> ring) {
  constexpr std::size_t kSamples = 255;
  const std::size_t stride = ring.size() / kSamples + 1;
  std::vector<float> sines;
  for (std::size_t k = 0; k < ring.size(); k += stride) {
    if (scan.range[ring[k]] > 0.0F) sines.push_back(scan.z[ring[k]] / scan.range[ring[k]]);
  }
  if (sines.empty()) return std::nullopt;
  const auto middle = sines.begin() + static_cast<std::ptrdiff_t>(sines.size() / 2);
  std::nth_element(sines.begin(), middle, sines.end());
  return *middle;
}

// A ring and where it belongs.
struct Place {
  std::size_t ring = 0;
  float elevation = 0.0F;
};

// The rings from the lowest to the highest. A ring without returns stays beside the one numbered before it.
std::vector<Place> places_of(const Scan& scan, const Grouped& grouped) {
  std::vector<Place> places;
  std::optional<float> before;
  std::ptrdiff_t climb = 0;  // positive where higher numbers mean higher rings
  std::size_t unknown_first = 0;
  for (std::size_t r = 0; r + 1 < grouped.begin.size(); ++r) {
    const std::size_t size = grouped.begin[r + 1] - grouped.begin[r];
    if (size == 0) continue;
    const auto here = elevation_of(scan, std::span(grouped.order).subspan(grouped.begin[r], size));
    if (here && before) climb += *here > *before ? 1 : (*here < *before ? -1 : 0);
    if (here) before = here;
    if (!before) ++unknown_first;
    places.push_back({.ring = r, .elevation = before.value_or(0.0F)});
  }
  if (unknown_first < places.size()) {
    for (std::size_t k = 0; k < unknown_first; ++k) places[k].elevation = places[unknown_first].elevation;
  }
  std::sort(places.begin(), places.end(), [climb](const Place& a, const Place& b) {
    if (a.elevation != b.elevation) return a.elevation < b.elevation;
    return climb < 0 ? a.ring > b.ring : a.ring < b.ring;
  });
  return places;
}

// Puts the points of `scan` in rings from the lowest to the highest and in order of azimuth.
void arrange(Scan& scan, const RingNumbers& rings) {
  Grouped grouped = group(rings);
  sort_rings_by_azimuth(scan, grouped.begin, grouped.order);
  std::vector<std::uint32_t> order;
  order.reserve(grouped.order.size());
  scan.ring_begin = {0};
  for (const Place& place : places_of(scan, grouped)) {
    const auto first = grouped.order.begin() + grouped.begin[place.ring];
    order.insert(order.end(), first, grouped.order.begin() + grouped.begin[place.ring + 1]);
    scan.ring_begin.push_back(static_cast<std::uint32_t>(order.size()));
  }
  permute_points(scan, order);
}

std::string note_of(const Organised& organised, const std::string& remark, bool times_used) {
  const Scan& scan = organised.scan;
  const auto source = enum_names<RingSource>.at(static_cast<std::size_t>(organised.source));
  std::string note =
      fmt::format("{} ring{} from the {}", scan.ring_count(), scan.ring_count() == 1 ? "" : "s", source);
  if (!remark.empty()) note += fmt::format(" ({})", remark);
  if (scan.dropped > 0) {
    note += fmt::format(", {} of {} points dropped (not finite or beyond 100 km)", scan.dropped,
                        scan.size() + scan.dropped);
  }
  if (!times_used) note += ", times left out (not finite or more than 4 s apart)";
  return note;
}

std::vector<std::int64_t> whole_ring_column(const Scan& scan) {
  const std::vector<std::uint32_t> ring = ring_of_points(scan);
  return {ring.begin(), ring.end()};
}

std::vector<double> time_column(const Scan& scan) {
  const double begin = static_cast<double>(scan.stamp_ns.value_or(0)) * 1e-9;
  std::vector<double> column(scan.time_offset_ns.size());
  std::transform(scan.time_offset_ns.begin(), scan.time_offset_ns.end(), column.begin(),
                 [begin](std::uint32_t offset) { return begin + static_cast<double>(offset) * 1e-9; });
  return column;
}

// Ring of each point, by the best source that there is.
std::pair<RingSource, RingNumbers> number_rings(const Scan& scan, std::span<const std::int64_t> field) {
  if (!field.empty()) return {RingSource::kField, rings_by_field(field)};
  if (auto rings = rings_by_order(scan, Seam::kUsual)) return {RingSource::kKittiOrder, std::move(*rings)};
  RingNumbers groups = rings_by_elevation(scan);
  if (groups.clear) return {RingSource::kElevation, std::move(groups)};
  if (auto rings = rings_by_order(scan, Seam::kAny)) return {RingSource::kKittiOrder, std::move(*rings)};
  return {RingSource::kElevation, std::move(groups)};
}

}  // namespace

Organised organise(Cloud cloud) {
  assert(cloud.y.size() == cloud.x.size() && cloud.z.size() == cloud.x.size());
  assert(cloud.x.size() < std::numeric_limits<std::uint32_t>::max());
  Organised organised;
  Scan& scan = organised.scan;
  scan = take_columns(cloud);
  drop_unusable(scan, cloud);
  const bool times_used = set_times(scan, cloud.time_s);
  RingNumbers rings;
  std::tie(organised.source, rings) = number_rings(scan, cloud.ring);
  arrange(scan, rings);
  organised.note = note_of(organised, rings.remark, times_used);
  return organised;
}

std::vector<std::uint32_t> ring_of_points(const Scan& scan) {
  std::vector<std::uint32_t> ring(scan.size());
  for (std::size_t r = 0; r < scan.ring_count(); ++r) {
    const auto [begin, end] = scan.ring(r);
    std::fill(ring.begin() + static_cast<std::ptrdiff_t>(begin),
              ring.begin() + static_cast<std::ptrdiff_t>(end), static_cast<std::uint32_t>(r));
  }
  return ring;
}

std::vector<std::uint32_t> input_order(const Scan& scan) {
  std::vector<std::uint32_t> order(scan.size());
  std::iota(order.begin(), order.end(), 0U);
  if (!scan.input_index.empty()) {
    std::stable_sort(order.begin(), order.end(), [&scan](std::uint32_t a, std::uint32_t b) {
      return scan.input_index[a] < scan.input_index[b];
    });
  }
  return order;
}

Cloud flatten(const Scan& scan) {
  const std::vector<std::uint32_t> order = input_order(scan);
  Cloud cloud{.x = gather(scan.x, order),
              .y = gather(scan.y, order),
              .z = gather(scan.z, order),
              .intensity = gather(scan.intensity, order),
              .ring = gather(whole_ring_column(scan), order),
              .time_s = gather(time_column(scan), order),
              .echo = gather(scan.echo, order),
              .pulse_width = gather(scan.pulse_width, order),
              .flags = gather(scan.flags, order),
              .label = gather(scan.label, order)};
  return cloud;
}

}  // namespace verge
