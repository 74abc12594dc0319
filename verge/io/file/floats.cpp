// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/io/file/floats.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/core.h>

namespace verge::io {
namespace {

constexpr std::size_t kRowsLookedAt = 1024;

bool is_coordinate(float value) {
  const float size = std::fabs(value);
  return size == 0.0F || (size >= 1e-20F && size <= 1e5F);
}

}  // namespace

bool is_bin_ring(float value) { return value >= 0.0F && value <= kRingMax && value == std::floor(value); }

RowCheck check_rows(Bytes bytes, std::size_t columns) {
  const std::size_t stride = columns * sizeof(float);
  RowCheck check;
  check.rows = std::min(bytes.size() / stride, kRowsLookedAt);
  for (std::size_t row = 0; row < check.rows; ++row) {
    const Bytes point = bytes.subspan(row * stride, stride);
    const auto all = [&](auto load) {
      return is_coordinate(load(0)) && is_coordinate(load(4)) && is_coordinate(load(8));
    };
    const float intensity = load_le<float>(point, 12);
    check.coordinates += all([&](std::size_t at) { return load_le<float>(point, at); }) ? 1U : 0U;
    check.swapped += all([&](std::size_t at) { return load_be<float>(point, at); }) ? 1U : 0U;
    check.intensities += intensity >= 0.0F && intensity <= 255.0F ? 1U : 0U;
    check.rings += columns > 4 && is_bin_ring(load_le<float>(point, 16)) ? 1U : 0U;
  }
  return check;
}

Expected<void> check_coordinates(const Input& input, Bytes bytes, std::size_t columns) {
  const RowCheck check = check_rows(bytes, columns);
  if (check.plausible()) return {};
  const char* what =
      check.is_big_endian() ? "coordinates are big-endian floats" : "coordinates are not metres of a scan";
  return Unexpected(input.error_at(ErrorCode::kUnusable, 0, what,
                                   fmt::format("{} of {} points plausible", check.coordinates, check.rows),
                                   "little-endian float32, at least half of them within 1e5 m"));
}

}  // namespace verge::io
