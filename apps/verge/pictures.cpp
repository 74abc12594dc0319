// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "apps/verge/pictures.hpp"

#include <stdexcept>
#include <string>
#include <system_error>
#include <utility>

#include <fmt/core.h>

#include "verge/core/atomic_file.hpp"

namespace verge::app {

Pictures::Pictures(std::filesystem::path folder, bool numbered, const emit::BevPlot::Config& config)
    : folder_(std::move(folder)), numbered_(numbered), plot_(config) {}

Expected<Pictures> Pictures::open(const std::filesystem::path& folder, bool numbered,
                                  const emit::BevPlot::Config& config) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) {
    return Unexpected({ErrorCode::kCannotWrite,
                       folder.string(),
                       {},
                       fmt::format("cannot make the folder: {}", error.message()),
                       {},
                       {}});
  }
  try {
    return Pictures(folder, numbered, config);
  } catch (const std::invalid_argument& refusal) {
    return Unexpected({ErrorCode::kUsage, "plot", {}, refusal.what(), {}, {}});
  }
}

Expected<void> Pictures::draw(const pipeline::Frame& frame) const {
  const std::string name = numbered_ ? fmt::format("{:06}_{}.png", frame.index, frame.scan.frame)
                                     : fmt::format("{}.png", frame.scan.frame);
  return plot_.write(folder_ / name, {.scan = frame.scan,
                                      .scene = frame.scene,
                                      .trace = frame.trace ? &*frame.trace : nullptr,
                                      .truth = nullptr});
}

Expected<void> Pictures::follow(const pipeline::Frame& frame) {
  constexpr std::size_t kScans = 600;  // so that memory does not grow with the recording
  if (!frame.trace) return {};
  widths_.add(frame.scene, *frame.trace);
  return widths_.size() < kScans ? Expected<void>{} : finish();
}

Expected<void> Pictures::finish() {
  const bool worth_it = widths_.has_lengths();
  const auto png = worth_it ? widths_.png() : Expected<std::string>{};
  widths_.clear();
  if (!png) return Unexpected(png.error());
  if (!worth_it) return {};
  return write_file(folder_ / fmt::format("road_width_{:06}.png", width_pictures_++), *png);
}

}  // namespace verge::app
