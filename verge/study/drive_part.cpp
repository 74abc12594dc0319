// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include <chrono>
#include <memory>
#include <utility>

#include <fmt/format.h>

#include "verge/pipeline/stages.hpp"
#include "verge/sim/seen_edges.hpp"
#include "verge/study/figures.hpp"
#include "verge/study/labelled_part.hpp"
#include "verge/study/parts.hpp"
#include "verge/study/thin.hpp"

namespace verge::study {
namespace {

template <class Action>
double seconds_of(Action&& action) {
  const auto begin = std::chrono::steady_clock::now();
  action();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

pipeline::Options options_of(const Contestant& contestant) {
  return {.mount_hint = {}, .mount_config = {}, .method = contestant.name, .config_hash = {}};
}

/// A Scene with its corners alone: those of a whole drive are kept until its end.
Scene corners_of(const Scene& scene) {
  Scene corners;
  corners.corners = scene.corners;
  return corners;
}

/// One contestant on its way along a drive.
class Driver {
 public:
  Driver(const Suite& suite, const Contestant& contestant)
      : suite_(suite), contestant_(contestant), detector_(detector_of(contestant)) {}

  /// The prepared scan, how long preparing took, and its place on the drive.
  void see(pipeline::Frame frame, double prepare_s, const Scene& truth, std::uint64_t drive,
           std::uint64_t index) {
    const double detect_s =
        seconds_of([&] { pipeline::detect_on(frame, *detector_, options_of(contestant_)); });
    tally_.seconds.add(prepare_s + detect_s);
    if (suite_.judged.corners) remember_corners(frame);
    if (!suite_.judged.boundaries && !suite_.judged.objects) {
      ++tally_.scans;
      return;
    }
    const auto evaluation = eval::evaluate_scene(&frame.scene, truth, suite_.evaluation);
    add_scene(tally_, evaluation);
    Tally scan;
    scan.cells = evaluation.cells;
    if (const auto f1 = headline_f1(scan)) note_poorest(tally_, {*f1, drive, index, frame.scan.frame});
  }

  [[nodiscard]] Tally finish(std::span<const Scene> truths) {
    std::vector<eval::CornerFrame> frames;
    for (std::size_t i = 0; i < predicted_.size(); ++i)
      frames.push_back({&predicted_[i], &truths[i], places_[i]});
    tally_.corners = eval::score_corners(frames);
    return std::move(tally_);
  }

 private:
  [[nodiscard]] std::optional<double> headline_f1(const Tally& scan) const {
    const eval::ToleranceCell* cell = headline_of(suite_, scan);
    return cell != nullptr ? cell->counts.f1() : std::nullopt;
  }

  void remember_corners(const pipeline::Frame& frame) {
    predicted_.push_back(corners_of(frame.scene));
    const auto& pose = frame.scan.T_world_sensor;
    places_.push_back(pose ? std::optional(pose->translation.xy()) : std::nullopt);
  }

  const Suite& suite_;
  const Contestant& contestant_;
  std::unique_ptr<detect::Detector> detector_;
  Tally tally_;
  std::vector<Scene> predicted_;
  std::vector<std::optional<Vec2>> places_;
};

std::uint64_t index_of(const MadeDrives& drives, std::size_t i) {
  return drives.first_scan + i * drives.step;
}

/// Independent detectors need to see that scan alone, others all before it.
Seen see_drive_again(const MadeDrives& drives, const ScanScore& wanted, const Contestant& contestant) {
  const sim::Drive world(drives.make(wanted.drive));
  const auto detector = detector_of(contestant);
  const bool alone = detector->order() == detect::Order::kIndependent;
  Seen seen;
  for (std::uint64_t index = alone ? wanted.scan : drives.first_scan; index <= wanted.scan;
       index += drives.step) {
    sim::Simulated simulated = simulated_of(drives, world, wanted.drive, index);
    seen.frame = {};
    seen.frame.scan = std::move(simulated.scan);
    pipeline::prepare(seen.frame, {});
    pipeline::detect_on(seen.frame, *detector, options_of(contestant));
    seen.truth = std::move(simulated.truth);
  }
  return seen;
}

}  // namespace

sim::Simulated simulated_of(const MadeDrives& drives, const sim::Drive& world, std::uint64_t drive,
                            std::uint64_t index) {
  sim::Simulated simulated = world.scan(index);
  simulated.scan = thin(std::move(simulated.scan), drives.lost, drive, index);
  simulated.scan.mount = drives.mount;
  if (drives.seen_edges) sim::tell_seen_edges(simulated.truth.boundaries, deskew(simulated.scan));
  return simulated;
}

std::optional<std::vector<Tally>> judge_drive(const Suite& suite, const MadeDrives& drives,
                                              std::uint64_t drive,
                                              std::span<const Contestant* const> contestants,
                                              const PartHooks& hooks) {
  const sim::Drive world(drives.make(drive));
  std::vector<Driver> drivers;
  for (const Contestant* contestant : contestants) drivers.emplace_back(suite, *contestant);
  std::vector<Scene> truths;
  for (std::size_t i = 0; i < drives.scans; ++i) {
    if (hooks.stop.load()) return std::nullopt;
    sim::Simulated simulated = simulated_of(drives, world, drive, index_of(drives, i));
    pipeline::Frame frame;
    frame.scan = std::move(simulated.scan);
    const double prepare_s = seconds_of([&] { pipeline::prepare(frame, {}); });
    for (Driver& driver : drivers) driver.see(frame, prepare_s, simulated.truth, drive, index_of(drives, i));
    if (suite.judged.corners) truths.push_back(corners_of(simulated.truth));
    hooks.scan_done();
  }
  std::vector<Tally> tallies;
  for (Driver& driver : drivers) tallies.push_back(driver.finish(truths));
  return tallies;
}

Expected<Seen> see_again(const Cell& cell, const ScanScore& scan, const Contestant& contestant) {
  if (const auto* set = std::get_if<LabelledScans>(&cell.scans))
    return see_labelled_again(*set, scan, contestant);
  return see_drive_again(std::get<MadeDrives>(cell.scans), scan, contestant);
}

}  // namespace verge::study
