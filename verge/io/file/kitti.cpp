// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/io/file/kitti.hpp"

#include <fmt/core.h>

#include "verge/io/file/floats.hpp"

namespace verge::io {
namespace {

constexpr std::size_t kStride = 4 * sizeof(float);

}  // namespace

Expected<Decoded> read_kitti(Input& input) {
  if (input.size() % kStride != 0) {
    return Unexpected(input.error_at(ErrorCode::kUnusable, input.size() - input.size() % kStride,
                                     "size is not a whole number of KITTI points",
                                     fmt::format("{} B", input.size()), "a multiple of 16 B"));
  }
  const std::uint64_t points = input.size() / kStride;
  if (points == 0) return Unexpected(input.error_at(ErrorCode::kDamaged, 0, "has 0 points"));
  if (auto allowed = input.allow(points, input.size()); !allowed) return Unexpected(allowed.error());
  const auto bytes = input.read(0, input.size());
  if (!bytes) return Unexpected(bytes.error());
  if (auto check = check_coordinates(input, *bytes, 4); !check) return Unexpected(check.error());

  Decoded out;
  Cloud& cloud = out.cloud;
  for (auto* column : {&cloud.x, &cloud.y, &cloud.z, &cloud.intensity}) column->resize(points);
  for (std::size_t i = 0; i < points; ++i) {
    const Bytes point = bytes->subspan(i * kStride, kStride);
    cloud.x[i] = load_le<float>(point, 0);
    cloud.y[i] = load_le<float>(point, 4);
    cloud.z[i] = load_le<float>(point, 8);
    cloud.intensity[i] = load_le<float>(point, 12);
  }
  return out;
}

}  // namespace verge::io
