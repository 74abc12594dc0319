// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include <fmt/format.h>

#include "verge/emit/width_plot.hpp"
#include "verge/pipeline/stages.hpp"
#include "verge/study/album.hpp"
#include "verge/study/parts.hpp"
#include "verge/study/report.hpp"

// Paper 1's Fig. 2 and 3 from our drives, and the road's width over time.

namespace verge::study {
namespace {

constexpr std::uint64_t kDrive = 1;
constexpr std::size_t kScans = 400;  // past the first corners and what looks like one
constexpr Reach kLines{12.0, 2.0, 7.0};

/// Where the first line is at the first true corner, as in Fig. 2 and 3.
enum class Phase { kStraight, kEntering, kPassing, kLeaving };
constexpr std::array kPhases = {std::pair(Phase::kStraight, "straight road (Fig. 2)"),
                                std::pair(Phase::kEntering, "entering a corner (Fig. 3-1)"),
                                std::pair(Phase::kPassing, "passing a corner (Fig. 3-2)"),
                                std::pair(Phase::kLeaving, "leaving a corner (Fig. 3-3)")};

bool is_in(Phase phase, const Corner& corner) {
  constexpr double kFirstLine_m = 5.0;
  constexpr double kWithin_m = 2.0;
  switch (phase) {
    case Phase::kStraight:
      return corner.distance_m < 3.0 * kFirstLine_m;
    case Phase::kEntering:
      return corner.distance_m < kFirstLine_m - 0.5 * kWithin_m;
    case Phase::kPassing:
      return corner.distance_m < kFirstLine_m - 2.0 * kWithin_m;
    case Phase::kLeaving:
      return corner.exit_m < kFirstLine_m;
  }
  return false;
}

/// A contestant on its way along the drive.
struct Follower {
  const Contestant& contestant;
  std::unique_ptr<detect::Detector> detector;
  emit::WidthPlot widths;
};

pipeline::Frame seen_by(Follower& follower, const Scan& scan) {
  pipeline::Frame frame;
  frame.scan = scan;
  pipeline::prepare(frame, {});
  detect_traced(frame, *follower.detector, follower.contestant.name);
  return frame;
}

const Corner* first_true(const Scene& truth, std::optional<int>& id) {
  for (const Corner& corner : truth.corners) {
    if (corner.confidence == 0.0 || (id && corner.id != *id)) continue;
    id = corner.id;
    return &corner;
  }
  return nullptr;
}

std::vector<Follower> followers_of(const Results& results) {
  std::vector<Follower> followers;
  for (const Contestant& contestant : results.contestants) {
    if (contestant.says.corners && !contestant.predictions)
      followers.push_back({contestant, detector_of(contestant), {}});
  }
  return followers;
}

/// The lines of the first method in each phase; all methods see the whole drive.
Expected<std::vector<Picture>> drive_past(const MadeDrives& drives, std::vector<Follower>& followers) {
  std::vector<Picture> pictures;
  const sim::Drive drive(drives.make(kDrive));
  std::optional<int> corner_id;
  for (std::size_t i = 0; i < std::min(kScans, drives.scans); ++i) {
    const sim::Simulated simulated = simulated_of(drives, drive, kDrive, i);
    const Corner* corner = first_true(simulated.truth, corner_id);
    for (Follower& follower : followers) {
      const pipeline::Frame frame = seen_by(follower, simulated.scan);
      follower.widths.add(frame.scene, *frame.trace);
      if (&follower != &followers.front() || pictures.size() == kPhases.size() || corner == nullptr) continue;
      const auto& [phase, name] = kPhases.at(pictures.size());
      if (!is_in(phase, *corner)) continue;
      auto picture = from_above(
          fmt::format("{}: {}", frame.scene.method, name),
          {.scan = frame.scan, .scene = frame.scene, .trace = &*frame.trace, .truth = &simulated.truth},
          kLines);
      if (!picture) return Unexpected(std::move(picture).error());
      pictures.push_back(*std::move(picture));
    }
  }
  return pictures;
}

}  // namespace

Expected<std::vector<Picture>> corner_pictures(const Results& results) {
  const Cell& cell = results.suite.cells[results.suite.cells.size() / 2];
  const auto* drives = std::get_if<MadeDrives>(&cell.scans);
  std::vector<Follower> followers = followers_of(results);
  if (!results.suite.judged.corners || drives == nullptr || followers.empty()) return std::vector<Picture>{};
  auto pictures = drive_past(*drives, followers);
  if (!pictures) return pictures;
  for (const Follower& follower : followers) {
    if (!follower.widths.has_lengths()) continue;
    auto png = follower.widths.png();
    if (!png) return Unexpected(std::move(png).error());
    pictures->push_back({*std::move(png), fmt::format("{}: the road's width from scan to scan; {}, drive {}",
                                                      follower.contestant.name, cell.name, kDrive)});
  }
  return pictures;
}

}  // namespace verge::study
