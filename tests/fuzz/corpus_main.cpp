// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0

// A fuzz target without a fuzzer: over its seeds and easy variations of them, or over files; or it writes its
// seeds.
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <random>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include "tests/fuzz/fuzz.hpp"

namespace {

namespace fs = std::filesystem;
using verge::fuzz::bytes_of;
using verge::fuzz::check;

std::string read(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::ostringstream bytes;
  bytes << in.rdbuf();
  return bytes.str();
}

int write_seeds(const fs::path& folder) {
  fs::create_directories(folder);
  std::size_t number = 0;
  for (const std::string& seed : verge::fuzz::seeds()) {
    std::ofstream(folder / ("seed" + std::to_string(number++)), std::ios::binary) << seed;
  }
  std::printf("%zu seeds in %s\n", number, folder.c_str());
  return 0;
}

std::size_t run_file_or_folder(const fs::path& path) {
  if (!fs::is_directory(path)) {
    check(bytes_of(read(path)));
    return 1;
  }
  std::size_t count = 0;
  for (const auto& entry : fs::directory_iterator(path)) count += run_file_or_folder(entry.path());
  return count;
}

/// The seed cut at up to `most` places, and as often with one byte changed.
std::size_t run_variations(const std::string& seed, std::size_t most, std::mt19937& random) {
  std::uniform_int_distribution<std::size_t> place(0, seed.empty() ? 0 : seed.size() - 1);
  std::uniform_int_distribution<int> value(0, 255);
  std::size_t count = 0;
  for (std::size_t k = 0; k < most && !seed.empty(); ++k) {
    check(bytes_of(seed.substr(0, place(random))));
    std::string changed = seed;
    changed[place(random)] = static_cast<char>(value(random));
    check(bytes_of(changed));
    count += 2;
  }
  return count;
}

int run_seeds() {
  constexpr std::size_t kVariations = 20;
  constexpr std::size_t kLargest = 1U << 16U;
  std::mt19937 random(20261122);
  const std::vector<std::string> seeds = verge::fuzz::seeds();
  std::size_t count = 0;
  for (const std::string& seed : seeds) {
    check(bytes_of(seed));
    ++count;
    if (seed.size() <= kLargest) count += run_variations(seed, kVariations, random);
  }
  std::printf("%zu inputs from %zu seeds\n", count, seeds.size());
  return seeds.empty() ? 1 : 0;
}

}  // namespace

int main(int argc, char** argv) {
  const std::vector<std::string_view> arguments(argv + 1, argv + argc);
  if (arguments.empty()) return run_seeds();
  if (arguments.size() == 2 && arguments[0] == "--write-seeds") return write_seeds(arguments[1]);
  std::size_t count = 0;
  for (const std::string_view path : arguments) count += run_file_or_folder(path);
  std::printf("%zu files\n", count);
  return 0;
}
