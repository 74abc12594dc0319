// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/eval/label_files.hpp"

#include <algorithm>
#include <utility>

#include <fmt/core.h>

#include "verge/core/bytes.hpp"
#include "verge/io/file/kitti.hpp"
#include "verge/io/file/nuscenes.hpp"
#include "verge/io/file/pcd.hpp"
#include "verge/io/input.hpp"

namespace verge::eval {
namespace {

namespace fs = std::filesystem;

/// Unsigned numbers of sizeof(T) bytes, little-endian, one behind the other.
template <class T>
Expected<std::vector<std::uint32_t>> read_numbers(const fs::path& path, std::size_t points) {
  auto input = io::Input::open(path, {});
  if (!input) return Unexpected(input.error());
  if (input->size() != points * sizeof(T)) {
    return Unexpected(
        input->error_at(ErrorCode::kUnusable, std::min<std::uint64_t>(input->size(), points * sizeof(T)),
                        "labels are not as many as the scan's points", fmt::format("{} B", input->size()),
                        fmt::format("{} B", points * sizeof(T))));
  }
  const auto bytes = input->read(0, input->size());
  if (!bytes) return Unexpected(bytes.error());
  std::vector<std::uint32_t> labels(points);
  for (std::size_t i = 0; i < points; ++i) labels[i] = load_le<T>(*bytes, i * sizeof(T));
  return labels;
}

auto reader_of(LabelFormat format) {
  if (format == LabelFormat::kSemanticKitti) return io::read_kitti;
  return format == LabelFormat::kNuscenes ? io::read_nuscenes : io::read_pcd;
}

}  // namespace

Expected<std::vector<std::uint32_t>> read_labels(LabelFormat format, const fs::path& path,
                                                 std::size_t points) {
  constexpr std::uint32_t kClass = 0xFFFFU;  // above it stands the instance
  if (format != LabelFormat::kSemanticKitti) return read_numbers<std::uint8_t>(path, points);
  auto labels = read_numbers<std::uint32_t>(path, points);
  if (!labels) return labels;
  for (std::uint32_t& label : *labels) label &= kClass;
  return labels;
}

Expected<LabelledCloud> read_labelled_cloud(LabelFormat format, const fs::path& scan,
                                            const fs::path& labels) {
  auto input = io::Input::open(scan, {});
  if (!input) return Unexpected(input.error());
  auto decoded = reader_of(format)(*input);
  if (!decoded) return Unexpected(std::move(decoded).error());
  auto numbers = read_labels(format, labels, decoded->cloud.x.size());
  if (!numbers) return Unexpected(std::move(numbers).error());
  return LabelledCloud{std::move(decoded->cloud), *std::move(numbers)};
}

}  // namespace verge::eval
