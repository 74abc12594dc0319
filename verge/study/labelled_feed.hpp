// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "verge/core/error.hpp"
#include "verge/eval/labelled_set.hpp"
#include "verge/io/source.hpp"
#include "verge/pipeline/run.hpp"

namespace verge::study {

inline constexpr double kLabelGap_m = 0.6;  ///< As `verge evaluate --labels`.

/// The folders in which the scans of a labelled set lie, each once, in order.
[[nodiscard]] std::vector<std::filesystem::path> scan_folders(std::span<const eval::LabelledScan> known);

/// Scans of folders or files as methods see them: prepared, in order.
class LabelledFeed {
 public:
  /// Scans that cannot be read are warned of, counted and left out.
  LabelledFeed(std::vector<std::filesystem::path> paths, std::function<void(const std::string&)> warning);

  /// The next scan that can be read, with the time that its mount took; none at the end. Fails as io::open().
  [[nodiscard]] Expected<std::optional<pipeline::Frame>> next();

  [[nodiscard]] std::size_t damaged() const { return damaged_; }

 private:
  [[nodiscard]] std::optional<pipeline::Frame> of_source();

  std::vector<std::filesystem::path> paths_;
  std::function<void(const std::string&)> warning_;
  std::size_t next_path_ = 0;
  std::unique_ptr<io::Source> source_;
  std::size_t damaged_ = 0;
};

}  // namespace verge::study
