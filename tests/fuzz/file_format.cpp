// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/fuzz/file_format.hpp"

#include <cmath>
#include <filesystem>
#include <fstream>
#include <numeric>
#include <sstream>

#include <unistd.h>

#include "tests/faults/samples.hpp"
#include "verge/core/error.hpp"

namespace verge::fuzz {
namespace fs = std::filesystem;
namespace {

constexpr std::size_t kLargestSeed = 1U << 16U;

/// A folder of this process that goes with it.
class Scratch {
 public:
  Scratch() : path_(fs::temp_directory_path() / ("verge-seeds-" + std::to_string(::getpid()))) {
    fs::create_directories(path_);
  }
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;
  ~Scratch() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  [[nodiscard]] const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

std::string bytes_in(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::ostringstream bytes;
  bytes << in.rdbuf();
  return bytes.str();
}

void check_scan(const Scan& scan) {
  require(scan.ring_begin.front() == 0 && scan.ring_begin.back() == scan.size());
  require(scan.size() > 0);
  for (std::size_t i = 0; i < scan.size(); ++i) {
    require(std::isfinite(scan.x[i]) && std::isfinite(scan.y[i]) && std::isfinite(scan.z[i]));
    require(scan.range[i] >= 0.0F && std::isfinite(scan.azimuth[i]));
  }
}

}  // namespace

std::vector<std::string> files_with_suffix(const std::string& suffix,
                                           const std::vector<faults::BadInput>& bad) {
  std::vector<std::string> seeds;
  for (const faults::Sample& sample : faults::samples(3, 5)) {
    if (sample.file.ends_with(suffix)) seeds.push_back(sample.bytes);
  }
  const Scratch scratch;
  for (const faults::BadInput& input : bad) {
    const fs::path file = input.make(scratch.path());
    const bool fits = fs::is_regular_file(file) && fs::file_size(file) <= kLargestSeed;
    if (fits) seeds.push_back(bytes_in(file));
  }
  return seeds;
}

void check_file(Bytes input, io::Format format) {
  io::OpenOptions options;
  options.format = format;
  const auto decode = [&] { return io::decode(input, "fuzz", options); };
  const auto once = bounded(input, decode);
  const auto again = bounded(input, decode);
  require(once.has_value() == again.has_value());
  // Where nobody says the format, it is told from the content, or the content is refused.
  static_cast<void>(bounded(input, [&] { return io::decode(input, "fuzz"); }));
  if (!once) {
    require(to_string(once.error()) == to_string(again.error()) && !once.error().what.empty());
    return;
  }
  check_scan(*once);
  require(once->x == again->x && once->y == again->y && once->z == again->z &&
          once->ring_begin == again->ring_begin && once->dropped == again->dropped);
}

}  // namespace verge::fuzz
