// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "verge/core/error.hpp"
#include "verge/study/contestant.hpp"
#include "verge/study/suite.hpp"
#include "verge/study/tally.hpp"

namespace verge::study {

/// How a suite is run.
struct RunOptions {
  std::size_t jobs = 0;  ///< Parts at once; 0: as many as the machine has threads.
  std::optional<std::filesystem::path>
      keep_in{};  ///< Folder for the parts that are done; made where missing.
  /// What else tells parts apart: the build of the program. Parts that another salt made are not used.
  std::string salt;
};

/// What a run tells while it goes on; called from several threads, one at a time.
struct RunHooks {
  std::function<void(std::size_t done, std::size_t total)> progress;  ///< Scans that this run has to make.
  std::function<void(const std::string&)> warning;
};

/// Results of a suite: one tally a cell and contestant.
struct Results {
  Suite suite;
  std::vector<Contestant> contestants;
  std::vector<Tally> tallies{};  ///< Cell by cell, within a cell contestant by contestant.
  std::size_t parts = 0;
  std::size_t parts_done = 0;  ///< Less than all where the run was stopped; tallies hold these alone.

  [[nodiscard]] const Tally& tally(std::size_t cell, std::size_t contestant) const {
    return tallies[cell * contestants.size() + contestant];
  }
};

/// Takes every contestant over every cell. A part is one drive, or one labelled set; its result is kept as a
/// file where asked for, under a name that its settings are hashed into, so that a later run with the same
/// settings takes it from there. A kept part that is damaged is made again, with a warning. The results are
/// the same at any number of jobs, kept or not, but for Tally::seconds.
///
/// `stop` ends the run after the scans under way; parts that are not done are given up. Fails as the readers
/// of labelled sets do, with kCannotWrite where a part cannot be kept, and with kUsage where a suite mixes
/// both kinds of cells. Predictions are looked up by frame: of made drives that of frame_of() in parts.hpp.
[[nodiscard]] Expected<Results> run(Suite suite, std::vector<Contestant> contestants,
                                    const RunOptions& options, const RunHooks& hooks,
                                    const std::atomic<bool>& stop);

}  // namespace verge::study
