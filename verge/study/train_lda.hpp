// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "verge/core/error.hpp"
#include "verge/detect/lda/lda.hpp"

namespace verge::study {

/// What the discriminant of method lda is trained on.
struct LdaTraining {
  detect::LdaConfig config{};  ///< Gate and windows; its model is not used.
  /// Made-up drives: those of "670 frames" of suite paper3, by numbers above a million, which the suite never
  /// takes.
  std::size_t drives = 20;
  std::size_t scans = 10;                     ///< Of each drive, 4 m apart.
  std::vector<std::filesystem::path> data{};  ///< Folders of labelled scans besides.
};

/// What trained a model.
struct LdaSource {
  std::string name;
  std::size_t scans = 0;
  std::size_t edge_windows = 0;
  std::size_t other_windows = 0;
};

struct LdaModel {
  detect::LdaConfig config;  ///< With the trained weights and threshold.
  std::vector<LdaSource> sources;
  // Every fifth scan of a source is held back: what the discriminant says of its windows.
  std::size_t held_edges = 0;
  std::size_t held_others = 0;
  double found_share = 0.0;  ///< Of the edges.
  double false_share = 0.0;  ///< Of the others.
};

struct LdaTrainingHooks {
  const std::atomic<bool>& stop;
  std::function<void(std::size_t done, std::size_t total)> progress;  ///< Scans.
  std::function<void(const std::string&)> warning;
};

/// Trains the discriminant (A2.3): windows along each scan line from the road's axis outward, as far as the
/// true edge; those whose middle is within 6 cm of it are edges, those half a metre before it and farther are
/// others; what lies in between, and scan lines that meet no edge, say nothing. Shrinkage 0.001. The same
/// training gives the same model. None where it was stopped. Fails as the readers of labelled sets do, and
/// with kUnusable where there are fewer than 500 windows of either kind.
[[nodiscard]] Expected<std::optional<LdaModel>> train_lda(const LdaTraining& training,
                                                          const LdaTrainingHooks& hooks);

/// The model as a file of settings (TOML) that `verge detect --config` takes; what trained it, how it was
/// made and what the features are stands in comments.
[[nodiscard]] std::string model_file(const LdaTraining& training, const LdaModel& model);

}  // namespace verge::study
