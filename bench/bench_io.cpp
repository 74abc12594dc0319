// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0

// Speed of the readers on one simulated scan of 64 rings a format, from the page cache. Every benchmark
// alternates with a plain pread of the same file into memory that is there already: the counter x_pread is
// the ratio of the two medians. What a reader gives is the Cloud; putting it in rings is measured by
// scan_bench.
#include <algorithm>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "tests/faults/bad_inputs.hpp"
#include "tests/faults/samples.hpp"
#include <benchmark/benchmark.h>
#include <fcntl.h>
#include <stdlib.h>
#include <time.h>
#include <unistd.h>

#include "verge/io/format/csv.hpp"
#include "verge/io/format/kitti.hpp"
#include "verge/io/format/nuscenes.hpp"
#include "verge/io/format/pcd.hpp"
#include "verge/io/format/ply.hpp"
#include "verge/io/sniff.hpp"

namespace verge::bench {
namespace {

namespace fs = std::filesystem;

/// Time of this thread alone, so that others on the machine disturb less.
double thread_seconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

double plain_read_seconds(const fs::path& file, std::vector<char>& into) {
  const double begin = thread_seconds();
  const int fd = ::open(file.c_str(), O_RDONLY | O_CLOEXEC);
  benchmark::DoNotOptimize(::pread(fd, into.data(), into.size(), 0));
  ::close(fd);
  return thread_seconds() - begin;
}

using Reader = Expected<io::Decoded> (*)(io::Input&);

/// Opens, tells the format and reads, as for each scan of a folder.
bool read_scan(const fs::path& file, Reader reader, io::Buffer& buffer) {
  auto input = io::Input::open(file, {}, std::move(buffer));
  if (!input || !io::sniff(*input)) return false;
  const auto decoded = reader(*input);
  buffer = std::move(*input).take_buffer();
  return decoded.has_value();
}

void read_beside_pread(benchmark::State& state, const std::string& name, const std::string& bytes,
                       Reader reader) {
  std::string pattern = (fs::temp_directory_path() / "verge-bench-XXXXXX").string();
  if (::mkdtemp(pattern.data()) == nullptr) return state.SkipWithError("no temporary folder");
  const fs::path file = fs::path(pattern) / name;
  faults::write(file, bytes);
  std::vector<char> into(bytes.size());
  io::Buffer buffer;
  std::vector<double> ours;
  std::vector<double> plain;
  for ([[maybe_unused]] auto _ : state) {
    plain.push_back(plain_read_seconds(file, into));
    const double begin = thread_seconds();
    if (!read_scan(file, reader, buffer)) state.SkipWithError("cannot read");
    ours.push_back(thread_seconds() - begin);
    state.SetIterationTime(ours.back());
  }
  state.counters["x_pread"] = median(ours) / median(plain);
  state.counters["MB_a_second"] = 1e-6 * static_cast<double>(bytes.size()) / median(ours);
  fs::remove_all(pattern);
}

void add_all() {
  struct Case {
    const char* name;
    const char* file;
    std::string bytes;
    Reader reader;
  };
  // 64 rings of 1,900 points: what an HDL-64E gives in a turn.
  const std::vector<faults::SamplePoint> points = faults::sample_points(64, 1900);
  const std::vector<Case> cases{
      {"kitti", "a.bin", faults::kitti(points), &io::read_kitti},
      {"nuscenes", "a.pcd.bin", faults::nuscenes(points), &io::read_nuscenes},
      {"pcd/binary", "a.pcd", faults::pcd_binary(points), &io::read_pcd},
      {"pcd/compressed", "a.pcd", faults::pcd_compressed(points), &io::read_pcd},
      {"pcd/ascii", "a.pcd", faults::pcd_ascii(points), &io::read_pcd},
      {"ply/big_endian", "a.ply", faults::ply_binary(points, true, false), &io::read_ply},
      {"ply/ascii", "a.ply", faults::ply_ascii(points, false), &io::read_ply},
      {"csv", "a.csv", faults::csv(points, true), &io::read_csv}};
  for (const Case& one : cases) {
    benchmark::RegisterBenchmark(
        one.name,
        [one](benchmark::State& state) { read_beside_pread(state, one.file, one.bytes, one.reader); })
        ->UseManualTime()
        ->Unit(benchmark::kMillisecond);
  }
}

}  // namespace
}  // namespace verge::bench

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  verge::bench::add_all();
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
  return 0;
}
