// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "verge/scan/rings.hpp"

namespace verge {
namespace {

// The distinct values of the field in rising order.
std::vector<std::int64_t> values_of(std::span<const std::int64_t> field) {
  std::vector<std::int64_t> values;
  for (const std::int64_t value : field) {
    if (values.empty() || values.back() != value) values.push_back(value);
  }
  std::sort(values.begin(), values.end());
  values.erase(std::unique(values.begin(), values.end()), values.end());
  return values;
}

// Numbers by table: for fields whose values lie close together, which is nearly all of them.
RingNumbers number_by_table(std::span<const std::int64_t> field, std::int64_t least, std::size_t width) {
  const auto place = [least](std::int64_t value) { return static_cast<std::size_t>(value - least); };
  std::vector<std::uint32_t> number(width, 0);
  for (const std::int64_t value : field) number[place(value)] = 1;
  std::uint32_t count = 0;
  for (std::uint32_t& n : number) n = n != 0 ? count++ : 0;
  RingNumbers rings{.ring_of = std::vector<std::uint32_t>(field.size()), .count = count};
  std::transform(field.begin(), field.end(), rings.ring_of.begin(),
                 [&](std::int64_t value) { return number[place(value)]; });
  return rings;
}

RingNumbers number_by_search(std::span<const std::int64_t> field) {
  const std::vector<std::int64_t> values = values_of(field);
  RingNumbers rings{.ring_of = std::vector<std::uint32_t>(field.size()), .count = values.size()};
  std::transform(field.begin(), field.end(), rings.ring_of.begin(), [&](std::int64_t value) {
    return static_cast<std::uint32_t>(std::lower_bound(values.begin(), values.end(), value) - values.begin());
  });
  return rings;
}

}  // namespace

RingNumbers rings_by_field(std::span<const std::int64_t> field) {
  if (field.empty()) return {};
  const auto [least, greatest] = std::minmax_element(field.begin(), field.end());
  // In unsigned arithmetic, where the difference of any two 64-bit integers is defined.
  const std::uint64_t spread = static_cast<std::uint64_t>(*greatest) - static_cast<std::uint64_t>(*least);
  constexpr std::uint64_t kTableMax = 65536;
  if (spread < kTableMax) return number_by_table(field, *least, static_cast<std::size_t>(spread) + 1);
  return number_by_search(field);
}

}  // namespace verge
