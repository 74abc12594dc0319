// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/io/file/nuscenes.hpp"

#include <limits>

#include <fmt/core.h>

#include "verge/io/file/floats.hpp"

namespace verge::io {
namespace {

constexpr std::size_t kStride = 5 * sizeof(float);

/// Size, memory and content of the file; its bytes.
Expected<Bytes> checked_bytes(Input& input) {
  if (input.size() % kStride != 0) {
    return Unexpected(input.error_at(ErrorCode::kUnusable, input.size() - input.size() % kStride,
                                     "size is not a whole number of nuScenes points",
                                     fmt::format("{} B", input.size()), "a multiple of 20 B"));
  }
  const std::uint64_t points = input.size() / kStride;
  if (points == 0) return Unexpected(input.error_at(ErrorCode::kDamaged, 0, "has 0 points"));
  if (auto allowed = input.allow(points, input.size()); !allowed) return Unexpected(allowed.error());
  const auto bytes = input.read(0, input.size());
  if (!bytes) return Unexpected(bytes.error());
  if (auto check = check_coordinates(input, *bytes, 5); !check) return Unexpected(check.error());
  return *bytes;
}

}  // namespace

Expected<Decoded> read_nuscenes(Input& input) {
  const auto bytes = checked_bytes(input);
  if (!bytes) return Unexpected(bytes.error());
  const std::size_t points = bytes->size() / kStride;
  Decoded out;
  Cloud& cloud = out.cloud;
  for (auto* column : {&cloud.x, &cloud.y, &cloud.z, &cloud.intensity}) column->resize(points);
  cloud.ring.resize(points);
  std::size_t bad = 0;
  for (std::size_t i = 0; i < points; ++i) {
    const Bytes point = bytes->subspan(i * kStride, kStride);
    const float ring = load_le<float>(point, 16);
    const bool good = is_bin_ring(ring);
    // The file's x points right and its y forward.
    cloud.x[i] = good ? load_le<float>(point, 4) : std::numeric_limits<float>::quiet_NaN();
    cloud.y[i] = -load_le<float>(point, 0);
    cloud.z[i] = load_le<float>(point, 8);
    cloud.intensity[i] = load_le<float>(point, 12);
    cloud.ring[i] = good ? static_cast<std::int64_t>(ring) : 0;
    bad += good ? 0U : 1U;
  }
  if (2 * bad > points) {
    return Unexpected(input.error_at(ErrorCode::kUnusable, 16, "fifth column is no ring",
                                     fmt::format("{} of {} points", bad, points), "integers 0 to 127"));
  }
  if (bad > 0)
    out.notes.push_back(fmt::format("{} of {} points have no valid ring and are dropped", bad, points));
  return out;
}

}  // namespace verge::io
