// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "apps/verge/suite_scans.hpp"

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <variant>

#include <fmt/format.h>

#include "apps/verge/progress.hpp"
#include "verge/emit/jsonl_writer.hpp"
#include "verge/io/sink.hpp"
#include "verge/study/figures.hpp"
#include "verge/study/made_scans.hpp"

namespace verge::app {
namespace {

std::size_t scans_in(const study::Suite& suite) {
  std::size_t scans = 0;
  for (const study::Cell& cell : suite.cells) {
    const auto& drives = std::get<study::MadeDrives>(cell.scans);
    scans += drives.drives * drives.scans;
  }
  return scans;
}

/// The scans of a suite on their way to their files.
class ScanWriter {
 public:
  ScanWriter(io::Sink& sink, emit::SceneWriter& truth, std::size_t scans, Console& console,
             const Signals& signals)
      : sink_(sink), truth_(truth), scans_(scans), console_(console), signals_(signals) {}

  [[nodiscard]] Expected<void> write_drive(const study::Cell& cell, std::uint64_t drive) {
    const auto& drives = std::get<study::MadeDrives>(cell.scans);
    const sim::Drive world(drives.make(drive));
    for (std::size_t i = 0; i < drives.scans && !signals_.stop(); ++i) {
      const std::uint64_t index = drives.first_scan + i * drives.step;
      sim::Simulated simulated = study::simulated_of(drives, world, drive, index);
      Scan scan = deskew(std::move(simulated.scan));
      scan.frame = simulated.truth.frame = study::frame_of(cell, drive, index);
      if (auto written = sink_.write(scan); !written) return written;
      if (auto written = truth_.write(simulated.truth); !written) return written;
      console_.progress(progress_line(++done_, scans_, seconds()));
    }
    return {};
  }

  [[nodiscard]] std::size_t done() const { return done_; }

 private:
  [[nodiscard]] double seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count();
  }

  io::Sink& sink_;
  emit::SceneWriter& truth_;
  std::size_t scans_;
  Console& console_;
  const Signals& signals_;
  std::size_t done_ = 0;
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
};

}  // namespace

Expected<void> write_suite_scans(const study::Suite& suite, const std::filesystem::path& folder,
                                 Console& console, const Signals& signals) {
  if (study::is_labelled(suite.cells.front()))
    return Unexpected(Error{ErrorCode::kUsage,
                            {},
                            {},
                            fmt::format("--write-scans: the scans of suite {} are files already", suite.name),
                            {},
                            {}});
  auto sink = io::create(folder / "scans", {.format = io::Format::kPcd, .log = console.log()});
  if (!sink) return Unexpected(std::move(sink).error());
  auto truth = emit::SceneWriter::open(folder / "truth.jsonl");
  if (!truth) return Unexpected(std::move(truth).error());
  ScanWriter writer(**sink, *truth, scans_in(suite), console, signals);
  for (const study::Cell& cell : suite.cells) {
    const std::size_t drives = std::get<study::MadeDrives>(cell.scans).drives;
    for (std::uint64_t drive = 1; drive <= drives && !signals.stop(); ++drive) {
      if (auto written = writer.write_drive(cell, drive); !written) return written;
    }
  }
  if (auto finished = (*sink)->finish(); !finished) return finished;
  console.print(fmt::format("verge: {} scans in {}, with the truth in {}\n", writer.done(),
                            (folder / "scans").string(), (folder / "truth.jsonl").string()));
  return truth->finish();
}

}  // namespace verge::app
