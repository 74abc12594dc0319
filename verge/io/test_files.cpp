// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/io/test_files.hpp"

#include <cmath>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <numbers>
#include <stdexcept>

#include <unistd.h>

#include "verge/scan/organise.hpp"

namespace verge::testing {
namespace fs = std::filesystem;

TemporaryFolder::TemporaryFolder() {
  std::string pattern = (fs::temp_directory_path() / "verge-io-XXXXXX").string();
  if (::mkdtemp(pattern.data()) == nullptr) throw std::runtime_error("no temporary folder");
  path_ = pattern;
  fs::permissions(path_, fs::perms::owner_all | fs::perms::others_read | fs::perms::others_exec);
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

fs::path TemporaryFolder::write(const fs::path& name, std::string_view bytes) const {
  const fs::path path = path_ / name;
  fs::create_directories(path.parent_path());
  std::ofstream file(path, std::ios::binary);
  file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  if (!file) throw std::runtime_error("cannot write " + path.string());
  return path;
}

std::string floats(const std::vector<float>& values) {
  std::string bytes(values.size() * sizeof(float), '\0');
  if (!values.empty()) std::memcpy(bytes.data(), values.data(), bytes.size());
  return bytes;
}

std::string floats(std::initializer_list<float> values) { return floats(std::vector<float>(values)); }

Bytes bytes_of(std::string_view text) { return std::as_bytes(std::span(text.data(), text.size())); }

std::string kitti_rings(std::size_t rings, std::size_t columns) {
  std::vector<float> values;
  for (std::size_t r = 0; r < rings; ++r) {
    const double elevation = 0.05 - 0.01 * static_cast<double>(r);
    for (std::size_t c = 0; c < columns; ++c) {
      const double azimuth =
          2.0 * std::numbers::pi * (static_cast<double>(c) + 0.5) / static_cast<double>(columns);
      for (const double value :
           {10.0 * std::cos(azimuth) * std::cos(elevation), 10.0 * std::sin(azimuth) * std::cos(elevation),
            10.0 * std::sin(elevation), 0.25}) {
        values.push_back(static_cast<float>(value));
      }
    }
  }
  return floats(values);
}

std::optional<fs::path> data_folder() {
  const char* folder = std::getenv("VERGE_DATA");
  if (folder == nullptr || *folder == '\0') return std::nullopt;
  return fs::path(folder);
}

std::vector<float> points_of(const Scan& scan) {
  const Cloud cloud = flatten(scan);
  std::vector<float> values;
  for (std::size_t i = 0; i < cloud.x.size(); ++i)
    values.insert(values.end(), {cloud.x[i], cloud.y[i], cloud.z[i]});
  return values;
}

}  // namespace verge::testing
