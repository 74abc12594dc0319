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
#include "verge/study/contestant.hpp"
#include "verge/study/made_scans.hpp"
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

/// A scan as a method saw it, and its truth as a Scene.
struct Seen {
  pipeline::Frame frame;
  Scene truth;
};

/// That scan again, for a picture. Fails as judge_labelled().
[[nodiscard]] Expected<Seen> see_again(const Cell& cell, const ScanScore& scan, const Contestant& contestant);

}  // namespace verge::study
