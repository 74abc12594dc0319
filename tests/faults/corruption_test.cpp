// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0

// Valid files cut at every byte, with every header field at its extremes, with every bit flipped: nothing
// crashes, memory stays bounded, and an error says a place inside the file.
#include <algorithm>
#include <charconv>
#include <random>
#include <string>
#include <string_view>
#include <vector>

#include <gtest/gtest.h>

#include "tests/faults/memory_meter.hpp"
#include "tests/faults/samples.hpp"
#include "verge/core/bytes.hpp"
#include "verge/core/error.hpp"
#include "verge/io/source.hpp"

namespace verge::faults {
namespace {

std::size_t number_of(std::string_view text) {
  std::size_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  EXPECT_TRUE(error == std::errc{} && end == text.data() + text.size()) << text;
  return value;
}

/// Whether "LINE:COL" or "OFFSET" lies inside the text, or one behind its end.
bool is_inside(std::string_view where, std::string_view bytes) {
  const std::size_t colon = where.find(':');
  if (colon == std::string_view::npos) return number_of(where) <= bytes.size();
  const std::size_t line = number_of(where.substr(0, colon));
  std::size_t begin = 0;
  for (std::size_t i = 1; i < line; ++i) {
    const std::size_t end = bytes.find('\n', begin);
    if (end == std::string_view::npos) return false;
    begin = end + 1;
  }
  const std::size_t end = std::min(bytes.find('\n', begin), bytes.size());
  const std::size_t column = number_of(where.substr(colon + 1));
  return line >= 1 && column >= 1 && column <= end - begin + 1;
}

/// Decodes what somebody did to a file, and checks what has to hold whatever that was.
void expect_handled(const std::string& bytes, const std::string& name, const std::string& what) {
  const MemoryMeter meter;
  const auto scan = io::decode(std::as_bytes(std::span(bytes.data(), bytes.size())), name);
  EXPECT_LE(meter.peak(), (16U << 20U) + 64 * bytes.size()) << name << ", " << what;
  if (scan) {
    EXPECT_GT(scan->size(), 0U) << name << ", " << what;
    return;
  }
  EXPECT_TRUE(is_inside(scan.error().where, bytes))
      << name << ", " << what << ": " << to_string(scan.error());
  EXPECT_EQ(scan.error().file, name);
}

std::string name_of(const ::testing::TestParamInfo<Sample>& info) {
  std::string name = info.param.file;
  std::replace(name.begin(), name.end(), '.', '_');
  return name;
}

class Corruption : public ::testing::TestWithParam<Sample> {};
class BinaryCorruption : public Corruption {};
class HeaderCorruption : public Corruption {};
class LasCorruption : public Corruption {};

constexpr std::size_t kRings = 3;
constexpr std::size_t kColumns = 5;

template <class Predicate>
std::vector<Sample> samples_that(Predicate predicate) {
  std::vector<Sample> all = samples(kRings, kColumns);
  std::erase_if(all, [&](const Sample& sample) { return !predicate(sample); });
  return all;
}

bool is_binary(const Sample& sample) {
  return sample.file.find("csv") == std::string::npos && sample.file.find("ascii") == std::string::npos;
}
bool is_las(const Sample& sample) { return sample.file.ends_with(".las"); }
bool has_header(const Sample& sample) { return sample.header > 0; }

/// Where the words of the header begin and how long they are.
std::vector<std::pair<std::size_t, std::size_t>> words_of(std::string_view header) {
  std::vector<std::pair<std::size_t, std::size_t>> words;
  std::size_t at = 0;
  while (at < header.size()) {
    at = header.find_first_not_of(" \n", at);
    if (at == std::string_view::npos) break;
    const std::size_t end = std::min(header.find_first_of(" \n", at), header.size());
    words.emplace_back(at, end - at);
    at = end;
  }
  return words;
}

}  // namespace

TEST_P(Corruption, TheSampleIsValid) {
  const Sample& sample = GetParam();
  const auto scan =
      io::decode(std::as_bytes(std::span(sample.bytes.data(), sample.bytes.size())), sample.file);
  ASSERT_TRUE(scan) << to_string(scan.error());
  EXPECT_EQ(scan->size(), 15U);
  EXPECT_EQ(scan->dropped, 0U);
}

TEST_P(Corruption, CutAtEveryByte) {
  const Sample& sample = GetParam();
  for (std::size_t size = 0; size < sample.bytes.size(); ++size) {
    expect_handled(sample.bytes.substr(0, size), sample.file, "cut at " + std::to_string(size));
  }
}

// Text may be cut behind its last digits and still say as many numbers.
TEST_P(BinaryCorruption, CutInItsDataItIsNeverWhole) {
  const Sample& sample = GetParam();
  for (std::size_t size = sample.header; size < sample.bytes.size(); ++size) {
    const std::string cut = sample.bytes.substr(0, size);
    const auto scan = io::decode(std::as_bytes(std::span(cut.data(), cut.size())), sample.file);
    if (scan) {
      EXPECT_EQ(sample.header, 0U) << "cut at " << size;  // bare floats: a whole number of points is a file
    }
    if (scan) {
      EXPECT_LT(scan->size(), 15U) << "cut at " << size;
    }
  }
}

TEST_P(HeaderCorruption, EveryFieldAtItsExtremes) {
  const Sample& sample = GetParam();
  const std::vector<std::string> extremes{"0",
                                          "1",
                                          "-1",
                                          "2",
                                          "127",
                                          "128",
                                          "255",
                                          "256",
                                          "32767",
                                          "32768",
                                          "65535",
                                          "65536",
                                          "2147483647",
                                          "2147483648",
                                          "4294967295",
                                          "4294967296",
                                          "9223372036854775807",
                                          "9223372036854775808",
                                          "18446744073709551615",
                                          "18446744073709551616",
                                          "-2147483648",
                                          "-9223372036854775808",
                                          "1e9",
                                          "1e400",
                                          "nan",
                                          "0x10",
                                          "",
                                          "x",
                                          "F",
                                          "_",
                                          "list",
                                          "vertex",
                                          "double",
                                          std::string(300, '9'),
                                          std::string(1, '\0')};
  for (const auto& [at, length] : words_of(std::string_view(sample.bytes).substr(0, sample.header))) {
    for (const std::string& extreme : extremes) {
      std::string bytes = sample.bytes;
      bytes.replace(at, length, extreme);
      expect_handled(bytes, sample.file, "'" + sample.bytes.substr(at, length) + "' is " + extreme);
    }
  }
}

// Wherever a field of 2, 4 or 8 bytes may stand in a header that is no text.
TEST_P(LasCorruption, EveryFieldAtItsExtremes) {
  const Sample& sample = GetParam();
  for (std::size_t at = 0; at < sample.bytes.size(); ++at) {
    for (const std::size_t width : {2U, 4U, 8U}) {
      if (at + width > sample.bytes.size()) continue;
      const auto low = std::string(width - 1, '\0');
      const auto high = std::string(width - 1, '\xFF');
      for (const std::string& extreme : {low + '\0', high + '\xFF', high + '\x7F', low + '\x80'}) {
        std::string bytes = sample.bytes;
        expect_handled(bytes.replace(at, width, extreme), sample.file,
                       std::to_string(width) + " bytes from " + std::to_string(at));
      }
    }
  }
}

TEST_P(Corruption, EveryBitFlipped) {
  const Sample& sample = GetParam();
  for (std::size_t at = 0; at < sample.bytes.size(); ++at) {
    for (unsigned bit = 0; bit < 8; ++bit) {
      std::string bytes = sample.bytes;
      bytes[at] = static_cast<char>(static_cast<unsigned char>(bytes[at]) ^ (1U << bit));
      expect_handled(bytes, sample.file, "bit " + std::to_string(bit) + " of byte " + std::to_string(at));
    }
  }
}

TEST_P(Corruption, RandomBytesInRandomPlaces) {
  const Sample& sample = GetParam();
  std::mt19937 random(20261122);
  std::uniform_int_distribution<std::size_t> place(0, sample.bytes.size() - 1);
  std::uniform_int_distribution<int> byte(0, 255);
  for (int round = 0; round < 1000; ++round) {
    std::string bytes = sample.bytes;
    for (int i = 0; i < 20; ++i) bytes[place(random)] = static_cast<char>(byte(random));
    expect_handled(bytes, sample.file, "round " + std::to_string(round));
  }
}

TEST_P(Corruption, UnderEveryOtherName) {
  const Sample& sample = GetParam();
  for (const char* name : {"a.bin", "a.pcd.bin", "a.pcd", "a.ply", "a.csv", "a", "velodyne/a.bin", ""}) {
    expect_handled(sample.bytes, name, sample.file);
  }
}

INSTANTIATE_TEST_SUITE_P(Samples, Corruption, ::testing::ValuesIn(samples(kRings, kColumns)), name_of);
INSTANTIATE_TEST_SUITE_P(Samples, BinaryCorruption, ::testing::ValuesIn(samples_that(&is_binary)), name_of);
INSTANTIATE_TEST_SUITE_P(Samples, LasCorruption, ::testing::ValuesIn(samples_that(&is_las)), name_of);
INSTANTIATE_TEST_SUITE_P(Samples, HeaderCorruption, ::testing::ValuesIn(samples_that(&has_header)), name_of);

}  // namespace verge::faults
