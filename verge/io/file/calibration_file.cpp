// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/io/file/calibration_file.hpp"

#include <cstdint>
#include <utility>

#include "verge/io/input.hpp"

namespace verge::io {

Expected<sensor::velodyne::Calibration> read_calibration_file(const std::filesystem::path& path,
                                                              std::size_t lasers) {
  constexpr std::uint64_t kMost = (1ULL << 20U) + 1;  // what read_calibration() refuses
  auto file = Input::open(path, {});
  if (!file) return Unexpected(std::move(file).error());
  const auto bytes = file->head(kMost);
  if (!bytes) return Unexpected(bytes.error());
  return sensor::velodyne::read_calibration(*bytes, path.string(), lasers);
}

}  // namespace verge::io
