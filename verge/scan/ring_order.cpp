// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/scan/ring_order.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <compare>

#include "verge/core/angle.hpp"

namespace verge {
namespace {

// Azimuth (as an unsigned number in the same order) above, index of the point below.
using Key = std::uint64_t;

// The bits of a float as a number that sorts like the float, -0 before +0, NaN at the ends: a total order.
std::uint32_t ordered_bits(float value) {
  const auto bits = std::bit_cast<std::uint32_t>(value);
  return (bits >> 31) != 0 ? ~bits : bits | 0x80000000U;
}

std::uint32_t azimuth_of(Key key) { return static_cast<std::uint32_t>(key >> 32); }
std::uint32_t index_of(Key key) { return static_cast<std::uint32_t>(key); }

std::strong_ordering compare(const std::vector<float>& column, std::size_t a, std::size_t b) {
  return column.empty() ? std::strong_ordering::equal : ordered_bits(column[a]) <=> ordered_bits(column[b]);
}

template <class T>
std::strong_ordering compare(const std::vector<T>& column, std::size_t a, std::size_t b) {
  return column.empty() ? std::strong_ordering::equal : column[a] <=> column[b];
}

// Which of two points with the same azimuth comes first.
bool precedes(const Scan& s, std::size_t a, std::size_t b) {
  if (const auto c = compare(s.z, a, b); std::is_neq(c)) return std::is_lt(c);
  if (const auto c = compare(s.x, a, b); std::is_neq(c)) return std::is_lt(c);
  if (const auto c = compare(s.y, a, b); std::is_neq(c)) return std::is_lt(c);
  if (const auto c = compare(s.intensity, a, b); std::is_neq(c)) return std::is_lt(c);
  if (const auto c = compare(s.time_offset_ns, a, b); std::is_neq(c)) return std::is_lt(c);
  if (const auto c = compare(s.echo, a, b); std::is_neq(c)) return std::is_lt(c);
  if (const auto c = compare(s.pulse_width, a, b); std::is_neq(c)) return std::is_lt(c);
  if (const auto c = compare(s.flags, a, b); std::is_neq(c)) return std::is_lt(c);
  if (const auto c = compare(s.label, a, b); std::is_neq(c)) return std::is_lt(c);
  if (const auto c = compare(s.input_index, a, b); std::is_neq(c)) return std::is_lt(c);
  return a < b;
}

// Turns a ring that was swept once, clockwise or counter-clockwise and from any azimuth, into a rising run.
void unroll(std::span<Key> keys) {
  std::size_t rises = 0;
  for (std::size_t i = 1; i < keys.size(); ++i) rises += keys[i] > keys[i - 1] ? 1U : 0U;
  if (2 * rises < keys.size()) std::reverse(keys.begin(), keys.end());
  std::size_t seam = 0;
  std::uint32_t greatest_fall = 0;
  for (std::size_t i = 1; i < keys.size(); ++i) {
    const std::uint32_t before = azimuth_of(keys[i - 1]);
    const std::uint32_t here = azimuth_of(keys[i]);
    if (here < before && before - here > greatest_fall) {
      greatest_fall = before - here;
      seam = i;
    }
  }
  std::rotate(keys.begin(), keys.begin() + static_cast<std::ptrdiff_t>(seam), keys.end());
}

// Insertion sort that gives up (false, keys in some order) when the keys turn out to be far from sorted.
bool insert_in_order(std::span<Key> keys) {
  std::size_t moves_left = 4 * keys.size() + 32;
  for (std::size_t i = 1; i < keys.size(); ++i) {
    const Key key = keys[i];
    std::size_t to = i;
    for (; to > 0 && keys[to - 1] > key && moves_left > 0; --to, --moves_left) keys[to] = keys[to - 1];
    keys[to] = key;
    if (moves_left == 0) return false;
  }
  return true;
}

// Stable counting sort by the 11 bits from `shift` on.
void sort_by_digit(std::span<const Key> from, std::span<Key> to, unsigned shift) {
  constexpr std::size_t kDigits = 1U << 11;
  std::array<std::uint32_t, kDigits + 1> place{};
  const auto digit = [shift](Key key) { return static_cast<std::size_t>(key >> shift) & (kDigits - 1); };
  for (const Key key : from) ++place[digit(key) + 1];
  for (std::size_t d = 1; d < place.size(); ++d) place[d] += place[d - 1];
  for (const Key key : from) to[place[digit(key)]++] = key;
}

void sort_keys(std::span<Key> keys, std::vector<Key>& spare) {
  unroll(keys);
  if (insert_in_order(keys)) return;
  constexpr std::size_t kWorthDigits = 256;
  if (keys.size() < kWorthDigits) {
    std::sort(keys.begin(), keys.end());
    return;
  }
  spare.resize(keys.size());
  sort_by_digit(keys, spare, 32);
  sort_by_digit(spare, keys, 43);
  sort_by_digit(keys, spare, 54);
  std::copy(spare.begin(), spare.end(), keys.begin());
}

// Runs of equal azimuth by the other columns.
void settle_ties(const Scan& scan, std::span<Key> keys) {
  const auto first_of_tie = [](Key a, Key b) { return azimuth_of(a) == azimuth_of(b); };
  for (auto at = keys.begin(); (at = std::adjacent_find(at, keys.end(), first_of_tie)) != keys.end();) {
    const auto end = std::find_if(at, keys.end(), [&](Key k) { return azimuth_of(k) != azimuth_of(*at); });
    std::sort(at, end, [&](Key a, Key b) { return precedes(scan, index_of(a), index_of(b)); });
    at = end;
  }
}

template <class T>
void permute(std::vector<T>& column, std::span<const std::uint32_t> order) {
  if (column.empty()) return;
  std::vector<T> permuted(order.size());
  for (std::size_t i = 0; i < order.size(); ++i) permuted[i] = column[order[i]];
  column = std::move(permuted);
}

}  // namespace

void measure_directions(Scan& scan) {
  const std::size_t n = scan.size();
  scan.azimuth.resize(n);
  scan.range.resize(n);
  const float* const x = scan.x.data();
  const float* const y = scan.y.data();
  const float* const z = scan.z.data();
  float* const azimuth = scan.azimuth.data();
  float* const range = scan.range.data();
  for (std::size_t i = 0; i < n; ++i) azimuth[i] = fast_atan2(y[i], x[i]);
  for (std::size_t i = 0; i < n; ++i) {
    const float squares = x[i] * x[i] + y[i] * y[i] + z[i] * z[i];
    // Where the squares vanish, the point need not: range 0 is the origin alone.
    range[i] = squares > 0.0F ? std::sqrt(squares) : std::fabs(x[i]) + std::fabs(y[i]) + std::fabs(z[i]);
  }
}

void sort_rings_by_azimuth(const Scan& scan, std::span<const std::uint32_t> ring_begin,
                           std::span<std::uint32_t> order) {
  std::vector<Key> keys;
  std::vector<Key> spare;
  for (std::size_t r = 0; r + 1 < ring_begin.size(); ++r) {
    const auto ring = order.subspan(ring_begin[r], ring_begin[r + 1] - ring_begin[r]);
    keys.resize(ring.size());
    std::transform(ring.begin(), ring.end(), keys.begin(), [&](std::uint32_t i) {
      return (static_cast<Key>(ordered_bits(scan.azimuth[i])) << 32) | i;
    });
    sort_keys(keys, spare);
    settle_ties(scan, keys);
    std::transform(keys.begin(), keys.end(), ring.begin(), index_of);
  }
}

void permute_points(Scan& scan, std::span<const std::uint32_t> order) {
  permute(scan.azimuth, order);
  permute(scan.range, order);
  permute(scan.x, order);
  permute(scan.y, order);
  permute(scan.z, order);
  permute(scan.intensity, order);
  permute(scan.time_offset_ns, order);
  permute(scan.echo, order);
  permute(scan.pulse_width, order);
  permute(scan.flags, order);
  permute(scan.label, order);
  permute(scan.input_index, order);
}

}  // namespace verge
