// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0

// Every bad input of the catalogue, through open() and next(): the error's code, what it says and where, how
// many points came out, and how much memory it took.
#include <algorithm>
#include <filesystem>
#include <ostream>
#include <set>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include "tests/faults/bad_inputs.hpp"
#include "tests/faults/counter_sums.hpp"
#include "tests/faults/memory_meter.hpp"
#include "verge/core/error.hpp"
#include "verge/io/source.hpp"

namespace verge::faults {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

Exit exit_of(ErrorCode code) {
  switch (code) {
    case ErrorCode::kUsage:
      return kUsage;
    case ErrorCode::kCannotOpen:
      return kCannotOpen;
    case ErrorCode::kUnusable:
      return kUnusable;
    case ErrorCode::kDamaged:
      return kDamaged;
    case ErrorCode::kTimeout:
      return kTimeout;
    default:
      return kLimit;
  }
}

io::Format format_named(const std::string& name) {
  const auto& names = enum_names<io::Format>;
  const auto found = std::find(names.begin(), names.end(), name);
  return static_cast<io::Format>(found - names.begin());
}

/// What became of an input.
struct Outcome {
  std::vector<Error> errors;
  std::string notes;
  std::size_t scans = 0;
  std::size_t used = 0;
  std::size_t dropped = 0;
  std::string warnings;
  std::vector<Scan> kept;
  std::vector<io::Counter> counters;

  [[nodiscard]] std::uint64_t count(const std::string& name) const {
    const auto found = std::find_if(counters.begin(), counters.end(),
                                    [&](const io::Counter& counter) { return counter.name == name; });
    return found == counters.end() ? 0 : found->count;
  }

  /// As the program ends: damage where some scans could be used, else the error.
  [[nodiscard]] Exit exit() const {
    if (errors.empty()) return kGood;
    return scans > 0 ? kDamaged : exit_of(errors.front().code);
  }
};

/// Reads the input to its end; the scans are kept where somebody wants to `keep` them.
Outcome read_all(const fs::path& path, const io::OpenOptions& options, bool keep) {
  Outcome outcome;
  io::OpenOptions listening = options;
  listening.log = [&](LogLevel level, std::string_view text) {
    outcome.notes.append(text).append("\n");
    if (level == LogLevel::kWarning) outcome.warnings.append(text).append("\n");
  };
  const auto source = io::open(path, listening);
  if (!source) {
    outcome.errors.push_back(source.error());
    return outcome;
  }
  while (true) {
    const auto scan = (*source)->next();
    if (!scan) {
      outcome.errors.push_back(scan.error());
      continue;
    }
    if (!*scan) break;
    ++outcome.scans;
    outcome.used += (*scan)->size();
    outcome.dropped += (*scan)->dropped;
    if (keep) outcome.kept.push_back(**scan);
  }
  outcome.counters = (*source)->counters();
  return outcome;
}

io::OpenOptions options_of(const BadInput& bad, const fs::path& path) {
  io::OpenOptions options{.timeout_ms = 50};
  if (!bad.format.empty()) options.format = format_named(bad.format);
  if (bad.memory_mib > 0) options.memory_max_bytes = std::uint64_t{bad.memory_mib} << 20U;
  if (!bad.sensor_ip.empty()) options.sensor_ip = bad.sensor_ip;
  if (!bad.model.empty()) options.model = bad.model;
  if (!bad.calibration.empty()) options.calibration = path.parent_path() / bad.calibration;
  return options;
}

void expect_same_scans(const std::vector<Scan>& a, const std::vector<Scan>& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a[i].stamp_ns, b[i].stamp_ns) << i;
    EXPECT_TRUE(a[i].x == b[i].x && a[i].y == b[i].y && a[i].z == b[i].z) << i;
    EXPECT_TRUE(a[i].intensity == b[i].intensity) << i;
  }
}

/// Bytes of the file, or of all files of the folder; what is no file has none.
std::size_t bytes_below(const fs::path& path) {
  std::error_code none;
  if (fs::is_regular_file(path, none)) return static_cast<std::size_t>(fs::file_size(path));
  std::size_t bytes = 0;
  if (!fs::is_directory(path, none)) return 0;
  for (const auto& entry : fs::directory_iterator(path)) {
    if (entry.is_regular_file(none)) bytes += static_cast<std::size_t>(entry.file_size());
  }
  return bytes;
}

/// Where `wanted`, somebody who is not the superuser, for as long as the object lives.
class PlainUser {
 public:
  explicit PlainUser(bool wanted)
      : is_needed_(wanted && ::geteuid() == 0), is_there_(!is_needed_ || ::seteuid(65534) == 0) {}
  PlainUser(const PlainUser&) = delete;
  PlainUser& operator=(const PlainUser&) = delete;
  ~PlainUser() {
    if (is_needed_ && is_there_ && ::seteuid(0) != 0) std::abort();
  }
  [[nodiscard]] bool is_there() const { return is_there_; }

 private:
  bool is_needed_;
  bool is_there_;
};

class Catalogue : public ::testing::TestWithParam<BadInput> {
 protected:
  void SetUp() override {
    std::string pattern = (fs::temp_directory_path() / "verge-faults-XXXXXX").string();
    ASSERT_NE(::mkdtemp(pattern.data()), nullptr);
    folder_ = pattern;
    fs::permissions(folder_, fs::perms::owner_all | fs::perms::others_read | fs::perms::others_exec);
  }
  void TearDown() override { fs::remove_all(folder_); }

  fs::path folder_;
};

std::string name_of(const ::testing::TestParamInfo<BadInput>& info) {
  return info.param.code + "_" + info.param.title;
}

}  // namespace

// gtest prints a parameter with this where a case fails.
void PrintTo(const BadInput& input, std::ostream* out) { *out << input.code << ' ' << input.title; }

TEST_P(Catalogue, EndsAsTheContractSays) {
  const BadInput& bad = GetParam();
  const fs::path path = bad.make(folder_);
  const PlainUser user(bad.as_user);
  if (!user.is_there()) GTEST_SKIP() << "cannot become a user without privileges";
  const io::OpenOptions options = options_of(bad, path);

  const MemoryMeter meter;
  const Outcome outcome = read_all(path, options, static_cast<bool>(bad.same_as));
  const std::size_t peak = meter.peak();

  EXPECT_EQ(outcome.exit(), bad.exit)
      << (outcome.errors.empty() ? "no error" : to_string(outcome.errors.front()));
  const std::string line = outcome.errors.empty() ? std::string() : to_string(outcome.errors.front());
  EXPECT_THAT(bad.exit == kGood ? outcome.notes : line, HasSubstr(bad.says));
  EXPECT_LE(line.size(), 280U);
  EXPECT_TRUE(std::none_of(line.begin(), line.end(), [](unsigned char c) { return c < 0x20 || c == 0x7F; }))
      << line;
  if (!bad.where.empty() && !outcome.errors.empty()) {
    EXPECT_EQ(outcome.errors.front().where, bad.where) << line;
  }
  if (bad.used) {
    EXPECT_EQ(outcome.used, *bad.used);
  }
  if (bad.dropped) {
    EXPECT_EQ(outcome.dropped, *bad.dropped);
  }
  if (bad.scans) {
    EXPECT_EQ(outcome.scans, *bad.scans);
  }
  EXPECT_THAT(outcome.warnings, HasSubstr(bad.warns));
  if (bad.exit == kDamaged) {
    EXPECT_EQ(outcome.errors.size(), bad.errors);
  }
  EXPECT_TRUE(add_up(outcome.counters));
  for (const auto& [name, count] : bad.counted) EXPECT_EQ(outcome.count(name), count) << name;
  if (bad.same_as) {
    fs::create_directory(folder_ / "same");
    expect_same_scans(outcome.kept, read_all(bad.same_as(folder_ / "same"), options, true).kept);
  }
  // The contract's bound: 16 MiB + 64 x what is there, and the ceiling.
  const std::size_t bound =
      bad.memory_mib > 0 ? bad.memory_mib << 20U : (16U << 20U) + 64 * bytes_below(path);
  EXPECT_LE(peak, bound);
}

INSTANTIATE_TEST_SUITE_P(BadInputs, Catalogue, ::testing::ValuesIn(bad_inputs()), name_of);

TEST(CatalogueItself, HasEveryCodeOfItsSectionsAndNoneTwice) {
  std::set<std::string> codes;
  for (const BadInput& input : bad_inputs()) {
    EXPECT_TRUE(codes.insert(input.code).second) << input.code << " stands twice";
  }
  const std::vector<std::pair<char, int>> sections{{'G', 16}, {'K', 7},  {'C', 16}, {'Y', 10},
                                                   {'S', 9},  {'L', 22}, {'A', 13}, {'R', 10},
                                                   {'P', 21}, {'V', 20}, {'N', 10}};
  const std::set<std::string> elsewhere{"G09", "G10", "G15",  // verge/io/input_test.cpp
                                        "L16"};               // live connections: not in a file
  for (const auto& [section, count] : sections) {
    for (int i = 1; i <= count; ++i) {
      const std::string code = section + std::string(i < 10 ? "0" : "") + std::to_string(i);
      const auto first = codes.lower_bound(code);
      const bool there = first != codes.end() && first->starts_with(code);
      EXPECT_TRUE(there || elsewhere.contains(code)) << code << " is missing";
    }
  }
}

}  // namespace verge::faults
