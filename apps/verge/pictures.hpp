// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>

#include "verge/core/error.hpp"
#include "verge/emit/bev_plot.hpp"
#include "verge/emit/width_plot.hpp"
#include "verge/pipeline/run.hpp"

namespace verge::app {

/// One bird's-eye picture a scan in a folder: FRAME.png, or NUMBER_FRAME.png where scans come from several
/// inputs, which may name them alike. draw() may be called by several threads.
class Pictures {
 public:
  /// Makes the folder where it is missing. Fails with kCannotWrite, or kUsage where the settings do not fit
  /// together.
  [[nodiscard]] static Expected<Pictures> open(const std::filesystem::path& folder, bool numbered,
                                               const emit::BevPlot::Config& config);

  [[nodiscard]] Expected<void> draw(const pipeline::Frame& frame) const;

  /// For pictures of many scans, in their order and one at a time: the road's width from scan to scan, where
  /// the method tells it, as road_width_NUMBER.png of up to 600 scans each.
  [[nodiscard]] Expected<void> follow(const pipeline::Frame& frame);
  [[nodiscard]] Expected<void> finish();

 private:
  Pictures(std::filesystem::path folder, bool numbered, const emit::BevPlot::Config& config);

  std::filesystem::path folder_;
  bool numbered_;
  emit::BevPlot plot_;
  emit::WidthPlot widths_;
  std::size_t width_pictures_ = 0;
};

}  // namespace verge::app
