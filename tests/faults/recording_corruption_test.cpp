// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0

// Valid recordings cut at every byte, with every field at its extremes, with every bit flipped: nothing
// crashes or goes on for ever, memory stays bounded, what was received is accounted for, and an error says a
// place inside the file.
#include <algorithm>
#include <charconv>
#include <cmath>
#include <random>
#include <string>
#include <string_view>
#include <vector>

#include <gtest/gtest.h>

#include "tests/faults/counter_sums.hpp"
#include "tests/faults/memory_meter.hpp"
#include "tests/faults/recording_samples.hpp"
#include "verge/io/recording.hpp"

namespace verge::faults {
namespace {

/// What is left of a recording.
struct Read {
  std::vector<std::vector<float>> scans;  // x of their points
  std::vector<Error> errors;
};

/// Whether "OFFSET" or "CHUNK+OFFSET" lies in the file, as far as it can be told; a row of a table has no
/// place in it, and what SQLite finds has none at all.
bool is_inside(std::string_view where, std::size_t size) {
  if (where.empty() || where.starts_with("messages row ")) return true;
  std::size_t offset = 0;
  const auto [end, error] = std::from_chars(where.data(), where.data() + where.size(), offset);
  const bool is_number = error == std::errc{} && (end == where.data() + where.size() || *end == '+');
  return is_number && offset <= size;
}

/// Reads what somebody made of a recording, and checks what has to hold whatever that was.
Read read_bad(const RecordingSample& sample, const std::string& bytes) {
  Read read;
  const MemoryMeter meter;
  auto recording = sample.open(io::Input::of(std::as_bytes(std::span(bytes)), "a.bin"), {});
  if (!recording) read.errors.push_back(recording.error());
  // A step takes a byte of the file at least, or of what is packed in it.
  for (std::size_t step = 0; recording; ++step) {
    if (step > 1024 * (bytes.size() + 1)) {
      ADD_FAILURE() << "goes on for ever";
      break;
    }
    const auto next = (*recording)->next();
    if (!next) {
      read.errors.push_back(next.error());
      continue;
    }
    if (!*next) break;
    read.scans.push_back((*next)->cloud.x);
  }
  EXPECT_TRUE(!recording || add_up((*recording)->counters()));
  EXPECT_LE(meter.peak(), (16U << 20U) + 64 * bytes.size());
  for (const Error& error : read.errors) {
    EXPECT_TRUE(is_inside(error.where, bytes.size())) << to_string(error);
    EXPECT_EQ(error.file, "a.bin");
  }
  return read;
}

/// Whether the byte stands amid others like it: then another one beside it shows what it does.
bool is_padding(const std::string& bytes, std::size_t at) {
  constexpr std::size_t kAround = 8;
  if (at < kAround || at + kAround >= bytes.size()) return false;
  const std::string_view around = std::string_view(bytes).substr(at - kAround, 2 * kAround + 1);
  return around.find_first_not_of(bytes[at]) == std::string_view::npos;
}

class RecordingCorruption : public ::testing::TestWithParam<RecordingSample> {};

INSTANTIATE_TEST_SUITE_P(Samples, RecordingCorruption, ::testing::ValuesIn(recording_samples()),
                         [](const auto& tested) { return tested.param.name; });

}  // namespace

TEST_P(RecordingCorruption, TheSampleIsValid) {
  const Read read = read_bad(GetParam(), GetParam().bytes);
  EXPECT_TRUE(read.errors.empty()) << to_string(read.errors.front());
  EXPECT_EQ(read.scans.size(), 3U);
}

// Of a stream of messages a cut loses the cut message alone; of any recording it makes no other scan.
TEST_P(RecordingCorruption, CutAtEveryByteItGivesTheScansBeforeTheCut) {
  const RecordingSample& sample = GetParam();
  const Read whole = read_bad(sample, sample.bytes);
  for (std::size_t size = 0; size < sample.bytes.size(); ++size) {
    const Read read = read_bad(sample, sample.bytes.substr(0, size));
    ASSERT_LE(read.scans.size(), 3U) << "cut at " << size;
    ASSERT_TRUE(std::equal(read.scans.begin(), read.scans.end(), whole.scans.begin())) << "cut at " << size;
    const bool is_stream = !sample.scan_ends.empty();  // which nothing says the length of
    ASSERT_TRUE(is_stream || read.scans.size() == 3 || !read.errors.empty())
        << "cut at " << size << ", silently";
    if (!is_stream) continue;
    const auto before = std::count_if(sample.scan_ends.begin(), sample.scan_ends.end(),
                                      [&](std::size_t end) { return end <= size; });
    ASSERT_EQ(read.scans.size(), static_cast<std::size_t>(before)) << "cut at " << size;
  }
}

TEST_P(RecordingCorruption, EveryBitFlipped) {
  const RecordingSample& sample = GetParam();
  for (std::size_t at = 0; at < sample.bytes.size(); ++at) {
    if (is_padding(sample.bytes, at)) continue;
    for (unsigned bit = 0; bit < 8; ++bit) {
      SCOPED_TRACE("bit " + std::to_string(bit) + " of byte " + std::to_string(at));
      std::string bytes = sample.bytes;
      bytes[at] = static_cast<char>(static_cast<unsigned char>(bytes[at]) ^ (1U << bit));
      static_cast<void>(read_bad(sample, bytes));
      if (HasFailure()) return;
    }
  }
}

// Wherever a field of 2, 4 or 8 bytes may stand: 0, -1, the greatest in the one order of bytes, the least in
// the other.
TEST_P(RecordingCorruption, EveryFieldAtItsExtremes) {
  const RecordingSample& sample = GetParam();
  for (std::size_t at = 0; at < sample.bytes.size(); ++at) {
    if (is_padding(sample.bytes, at)) continue;
    for (const std::size_t width : {2U, 4U, 8U}) {
      if (at + width > sample.bytes.size()) continue;
      const auto low = std::string(width - 1, '\0');
      const auto high = std::string(width - 1, '\xFF');
      for (const std::string& extreme : {low + '\0', high + '\xFF', high + '\x7F', '\x80' + low}) {
        SCOPED_TRACE(std::to_string(width) + " bytes from " + std::to_string(at));
        std::string bytes = sample.bytes;
        static_cast<void>(read_bad(sample, bytes.replace(at, width, extreme)));
        if (HasFailure()) return;
      }
    }
  }
}

TEST_P(RecordingCorruption, RandomBytesInRandomPlaces) {
  const RecordingSample& sample = GetParam();
  std::mt19937 random(20261122);
  std::uniform_int_distribution<std::size_t> place(0, sample.bytes.size() - 1);
  std::uniform_int_distribution<int> byte(0, 255);
  for (int round = 0; round < 1000; ++round) {
    SCOPED_TRACE("round " + std::to_string(round));
    std::string bytes = sample.bytes;
    for (int i = 0; i < 20; ++i) bytes[place(random)] = static_cast<char>(byte(random));
    static_cast<void>(read_bad(sample, bytes));
    if (HasFailure()) return;
  }
}

}  // namespace verge::faults
