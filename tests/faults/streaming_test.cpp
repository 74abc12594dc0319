// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0

// Memory does not grow with the recording.
#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <string>

#include <gtest/gtest.h>

#include "tests/faults/bad_inputs.hpp"
#include "tests/faults/memory_meter.hpp"
#include "tests/faults/samples.hpp"
#include "verge/io/source.hpp"

namespace verge::faults {
namespace {

namespace fs = std::filesystem;

/// The most memory that reading the next scans took beyond what was out before.
std::size_t peak_of(io::Source& source, int scans) {
  const MemoryMeter meter;
  for (int i = 0; i < scans; ++i) {
    const auto scan = source.next();
    EXPECT_TRUE(scan && *scan);
  }
  return meter.peak();
}

class Streaming : public ::testing::TestWithParam<Sample> {};

std::string name_of(const ::testing::TestParamInfo<Sample>& info) {
  std::string name = info.param.file;
  std::replace(name.begin(), name.end(), '.', '_');
  return name;
}

}  // namespace

TEST_P(Streaming, TheTwoHundredthScanTakesNoMoreThanTheSecond) {
  std::string pattern = (fs::temp_directory_path() / "verge-streaming-XXXXXX").string();
  ASSERT_NE(::mkdtemp(pattern.data()), nullptr);
  const fs::path folder(pattern);
  const std::string suffix = GetParam().file.substr(GetParam().file.find('.'));
  write(folder / "scan", GetParam().bytes);
  for (int i = 0; i < 200; ++i) fs::create_symlink("scan", folder / (std::to_string(i) + suffix));
  const auto source = io::open(folder);
  ASSERT_TRUE(source) << to_string(source.error());
  static_cast<void>(peak_of(**source, 1));  // the first one brings the buffer
  const std::size_t second = peak_of(**source, 1);
  const std::size_t rest = peak_of(**source, 198);
  EXPECT_FALSE((*source)->next().value());
  EXPECT_GT(second, 4'000U * 28U);  // a scan of 4,000 points is at least that: the meter meters
  EXPECT_LE(rest, second + 4096);
  fs::remove_all(folder);
}

INSTANTIATE_TEST_SUITE_P(Samples, Streaming, ::testing::ValuesIn(samples(16, 250)), name_of);

}  // namespace verge::faults
