// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0

// Speed of the readers on one simulated scan of 64 rings, from the page cache. Every benchmark
// alternates with a plain pread of the same file into memory that is there already: the counter x_pread is
// the ratio of the two medians. What a reader gives is the Cloud; putting it in rings is measured by
// scan_bench.
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include <benchmark/benchmark.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include "bench/measure.hpp"
#include "verge/core/atomic_file.hpp"
#include "verge/io/file/csv.hpp"
#include "verge/io/file/kitti.hpp"
#include "verge/io/file/nuscenes.hpp"
#include "verge/io/file/pcd.hpp"
#include "verge/io/sniff.hpp"
#include "verge/scan/organise.hpp"
#include "verge/scan/test_clouds.hpp"

namespace verge::bench {
namespace {

namespace fs = std::filesystem;

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

void read_beside_pread(benchmark::State& state, const fs::path& file, Reader reader) {
  std::vector<char> into(fs::file_size(file));
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
  state.counters["x_pread"] = typical(ours) / typical(plain);
  state.counters["MB_a_second"] = 1e-6 * static_cast<double>(into.size()) / typical(ours);
}

/// One scan in every format, for as long as the object lives.
class Files {
 public:
  Files() : folder_(fs::temp_directory_path() / fmt::format("verge-bench-{}", ::getpid())) {
    fs::create_directories(folder_);
    // What an HDL-64E gives in a turn.
    const Scan scan = organise(testing::simulate(testing::plan(64, -24.8, 2.0, 1900))).scan;
    std::string pcd = fmt::format(
        "FIELDS x y z intensity ring\nSIZE 4 4 4 4 2\nTYPE F F F F U\nPOINTS {}\nDATA ascii\n", scan.size());
    std::string csv = "number,level,distance,x,y,z\n";
    std::vector<float> kitti;
    for (std::size_t r = 0; r < scan.ring_count(); ++r) {
      for (auto [i, end] = scan.ring(r); i < end; ++i) {
        kitti.insert(kitti.end(), {scan.x[i], scan.y[i], scan.z[i], scan.intensity[i]});
        pcd += fmt::format("{} {} {} {} {}\n", scan.x[i], scan.y[i], scan.z[i], scan.intensity[i], r);
        csv += fmt::format("{},{},{:.4f},{:.4f},{:.4f},{:.4f}\n", i, r, scan.range[i], scan.x[i], scan.y[i],
                           scan.z[i]);
      }
    }
    const auto* bytes = reinterpret_cast<const char*>(kitti.data());
    good_ = write_file(path("kitti.bin"), {bytes, kitti.size() * sizeof(float)}) &&
            io::write_nuscenes(path("nuscenes.pcd.bin"), scan) && io::write_pcd(path("binary.pcd"), scan) &&
            write_file(path("ascii.pcd"), pcd) && write_file(path("table.csv"), csv);
  }
  Files(const Files&) = delete;
  Files& operator=(const Files&) = delete;
  ~Files() {
    std::error_code ignored;
    fs::remove_all(folder_, ignored);
  }

  [[nodiscard]] bool good() const { return good_; }
  [[nodiscard]] fs::path path(const char* name) const { return folder_ / name; }

 private:
  fs::path folder_;
  bool good_ = false;
};

void add_all(const Files& files) {
  const std::vector<std::pair<const char*, Reader>> cases{{"kitti.bin", &io::read_kitti},
                                                          {"nuscenes.pcd.bin", &io::read_nuscenes},
                                                          {"binary.pcd", &io::read_pcd},
                                                          {"ascii.pcd", &io::read_pcd},
                                                          {"table.csv", &io::read_csv}};
  for (const auto& [name, reader] : cases) {
    benchmark::RegisterBenchmark(name,
                                 [file = files.path(name), reader = reader](benchmark::State& state) {
                                   read_beside_pread(state, file, reader);
                                 })
        ->UseManualTime()
        ->Unit(benchmark::kMillisecond);
  }
}

}  // namespace
}  // namespace verge::bench

int main(int argc, char** argv) {
  const verge::bench::Files files;
  if (!files.good()) return 1;
  return verge::bench::run_benchmarks(argc, argv, [&] { verge::bench::add_all(files); });
}
