// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/study/made_scans.hpp"

#include <cctype>
#include <cstddef>
#include <utility>
#include <variant>

#include <fmt/format.h>

#include "verge/sim/seen_edges.hpp"
#include "verge/study/thin.hpp"

namespace verge::study {

std::string frame_of(const Cell& cell, std::uint64_t drive, std::uint64_t index) {
  std::string name;
  for (const char c : cell.name) name += std::isalnum(static_cast<unsigned char>(c)) != 0 ? c : '-';
  return fmt::format("{}-{}-{:06}", name, drive, index);
}

std::vector<std::string> frames_of(const Suite& suite) {
  std::vector<std::string> frames;
  for (const Cell& cell : suite.cells) {
    const auto* drives = std::get_if<MadeDrives>(&cell.scans);
    if (drives == nullptr) continue;
    for (std::uint64_t drive = 1; drive <= drives->drives; ++drive) {
      for (std::size_t i = 0; i < drives->scans; ++i)
        frames.push_back(frame_of(cell, drive, drives->first_scan + i * drives->step));
    }
  }
  return frames;
}

sim::Simulated simulated_of(const MadeDrives& drives, const sim::Drive& world, std::uint64_t drive,
                            std::uint64_t index) {
  sim::Simulated simulated = world.scan(index);
  simulated.scan = thin(std::move(simulated.scan), drives.lost, drive, index);
  simulated.scan.mount = drives.mount;
  if (drives.seen_edges) sim::tell_seen_edges(simulated.truth.boundaries, deskew(simulated.scan));
  return simulated;
}

}  // namespace verge::study
