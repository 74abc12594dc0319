// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "verge/core/error.hpp"
#include "verge/eval/labelled_set.hpp"
#include "verge/model/scene.hpp"
#include "verge/pipeline/run.hpp"
#include "verge/sim/drive.hpp"
#include "verge/study/contestant.hpp"
#include "verge/study/suite.hpp"
#include "verge/study/tally.hpp"

// The work of a suite's parts: scans through detectors, and what comes out against the truth.

namespace verge::study {

/// What a part hears and says while it runs.
struct PartHooks {
  const std::atomic<bool>& stop;
  std::function<void()> scan_done;
  std::function<void(const std::string&)> warning;
};

/// What a scan of a made drive is called: "670-frames-3-000045" is of cell "670 frames", drive 3, scan 45. By
/// these names predictions are found.
[[nodiscard]] std::string frame_of(const Cell& cell, std::uint64_t drive, std::uint64_t index);

/// All of a suite's made drives.
[[nodiscard]] std::vector<std::string> frames_of(const Suite& suite);

/// One drive past these contestants: a tally each, or none where it was stopped. The cell is of made drives.
/// Throws std::invalid_argument where it makes no drive of that number.
[[nodiscard]] std::optional<std::vector<Tally>> judge_drive(const Suite& suite, const Cell& cell,
                                                            std::uint64_t drive,
                                                            std::span<const Contestant* const> contestants,
                                                            const PartHooks& hooks);

/// The scans of a set. Fails as eval::find_labelled_scans() and eval::find_boxed_scans().
[[nodiscard]] Expected<std::vector<eval::LabelledScan>> known_scans(const LabelledScans& set);

/// The labelled scans of a set, `known` is what known_scans() has of it: the contestant's
/// tally, or none where it was stopped. Scans that cannot be read are warned of and count as damaged. Fails
/// as io::open() and eval::read_labelled_truth() do.
[[nodiscard]] Expected<std::optional<Tally>> judge_labelled(const LabelledScans& set,
                                                            std::span<const eval::LabelledScan> known,
                                                            const Contestant& contestant,
                                                            const PartHooks& hooks);

/// Scan `index` of the world of one of these drives: with what is lost of it and what methods are told, and
/// the truth of which that much is visible. Its frame is its index.
[[nodiscard]] sim::Simulated simulated_of(const MadeDrives& drives, const sim::Drive& world,
                                          std::uint64_t drive, std::uint64_t index);

/// A scan as a method saw it, and its truth as a Scene.
struct Seen {
  pipeline::Frame frame;
  Scene truth;
};

/// That scan again, for a picture. Fails as judge_labelled().
[[nodiscard]] Expected<Seen> see_again(const Cell& cell, const ScanScore& scan, const Contestant& contestant);

}  // namespace verge::study
