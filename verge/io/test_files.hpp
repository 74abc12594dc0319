// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "verge/core/bytes.hpp"
#include "verge/core/error.hpp"
#include "verge/scan/scan.hpp"

// Small files for the tests of the io room.

namespace verge::testing {

/// A folder that goes with the object.
class TemporaryFolder {
 public:
  TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  ~TemporaryFolder();

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  /// The file `name` (folders are made) with these bytes; its path.
  std::filesystem::path write(const std::filesystem::path& name, std::string_view bytes) const;

 private:
  std::filesystem::path path_;
};

/// Numbers as little-endian bytes.
[[nodiscard]] std::string floats(std::initializer_list<float> values);
[[nodiscard]] std::string floats(const std::vector<float>& values);
/// The text's bytes.
[[nodiscard]] Bytes bytes_of(std::string_view text);

/// A KITTI file of `rings` rings from the top, each of `columns` points at 10 m, counter-clockwise from
/// azimuth 0.
[[nodiscard]] std::string kitti_rings(std::size_t rings, std::size_t columns);

/// The folder VERGE_DATA, if set.
[[nodiscard]] std::optional<std::filesystem::path> data_folder();

/// The points of the scan in the input's order as x, y, z, one after the other.
[[nodiscard]] std::vector<float> points_of(const Scan& scan);

}  // namespace verge::testing
