// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include <chrono>
#include <memory>
#include <utility>

#include "verge/pipeline/stages.hpp"
#include "verge/study/figures.hpp"
#include "verge/study/labelled_part.hpp"
#include "verge/study/parts.hpp"

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

/// Puts what the predictions say of it into the frame; false where they do not have it.
bool look_up(pipeline::Frame& frame, const Contestant& contestant) {
  const auto found = contestant.predictions->find(frame.scan.frame);
  if (found == contestant.predictions->end()) return false;
  frame.scene = found->second;
  return true;
}

/// One contestant on its way along a drive.
class Driver {
 public:
  Driver(const Suite& suite, const Contestant& contestant)
      : suite_(suite),
        contestant_(contestant),
        detector_(contestant.predictions ? nullptr : detector_of(contestant)) {}

  /// The prepared scan, how long preparing took, and its place on the drive.
  void see(pipeline::Frame frame, double prepare_s, const Scene& truth, std::uint64_t drive,
           std::uint64_t index) {
    if (detector_) {
      const double detect_s =
          seconds_of([&] { pipeline::detect_on(frame, *detector_, options_of(contestant_)); });
      tally_.seconds.add(prepare_s + detect_s);
    } else if (!look_up(frame, contestant_)) {
      ++tally_.absent;
    }
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

/// A scan of a drive under the name that predictions know, prepared, and its truth.
Seen see_scan(const Cell& cell, const sim::Drive& world, std::uint64_t drive, std::uint64_t index) {
  sim::Simulated simulated = simulated_of(std::get<MadeDrives>(cell.scans), world, drive, index);
  Seen seen{{}, std::move(simulated.truth)};
  seen.frame.scan = std::move(simulated.scan);
  seen.frame.scan.frame = frame_of(cell, drive, index);
  return seen;
}

/// Independent detectors need to see that scan alone, others all before it.
Seen see_drive_again(const Cell& cell, const ScanScore& wanted, const Contestant& contestant) {
  const auto& drives = std::get<MadeDrives>(cell.scans);
  const sim::Drive world(drives.make(wanted.drive));
  const auto detector = contestant.predictions ? nullptr : detector_of(contestant);
  const bool alone = !detector || detector->order() == detect::Order::kIndependent;
  Seen seen;
  for (std::uint64_t index = alone ? wanted.scan : drives.first_scan; index <= wanted.scan;
       index += drives.step) {
    seen = see_scan(cell, world, wanted.drive, index);
    pipeline::prepare(seen.frame, {});
    if (detector) {
      pipeline::detect_on(seen.frame, *detector, options_of(contestant));
    } else {
      look_up(seen.frame, contestant);
    }
  }
  return seen;
}

}  // namespace

std::optional<std::vector<Tally>> judge_drive(const Suite& suite, const Cell& cell, std::uint64_t drive,
                                              std::span<const Contestant* const> contestants,
                                              const PartHooks& hooks) {
  const auto& drives = std::get<MadeDrives>(cell.scans);
  const sim::Drive world(drives.make(drive));
  std::vector<Driver> drivers;
  for (const Contestant* contestant : contestants) drivers.emplace_back(suite, *contestant);
  std::vector<Scene> truths;
  for (std::size_t i = 0; i < drives.scans; ++i) {
    if (hooks.stop.load()) return std::nullopt;
    const std::uint64_t index = drives.first_scan + i * drives.step;
    Seen seen = see_scan(cell, world, drive, index);
    const double prepare_s = seconds_of([&] { pipeline::prepare(seen.frame, {}); });
    for (Driver& driver : drivers) driver.see(seen.frame, prepare_s, seen.truth, drive, index);
    if (suite.judged.corners) truths.push_back(corners_of(seen.truth));
    hooks.scan_done();
  }
  std::vector<Tally> tallies;
  for (Driver& driver : drivers) tallies.push_back(driver.finish(truths));
  return tallies;
}

Expected<Seen> see_again(const Cell& cell, const ScanScore& scan, const Contestant& contestant) {
  if (const auto* set = std::get_if<LabelledScans>(&cell.scans))
    return see_labelled_again(*set, scan, contestant);
  return see_drive_again(cell, scan, contestant);
}

}  // namespace verge::study
