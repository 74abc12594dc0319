// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/study/labelled_feed.hpp"

#include <algorithm>
#include <chrono>
#include <utility>

#include "verge/pipeline/stages.hpp"

namespace verge::study {
namespace fs = std::filesystem;

std::vector<fs::path> scan_folders(std::span<const eval::LabelledScan> known) {
  std::vector<fs::path> folders;
  for (const eval::LabelledScan& scan : known) {
    const fs::path folder = scan.scan.parent_path();
    if (!scan.scan.empty() && std::ranges::find(folders, folder) == folders.end()) folders.push_back(folder);
  }
  return folders;
}

LabelledFeed::LabelledFeed(std::vector<fs::path> paths, std::function<void(const std::string&)> warning)
    : paths_(std::move(paths)), warning_(std::move(warning)) {}

Expected<std::optional<pipeline::Frame>> LabelledFeed::next() {
  while (true) {
    if (!source_) {
      if (next_path_ == paths_.size()) return std::optional<pipeline::Frame>();
      auto opened = io::open(paths_[next_path_++]);
      if (!opened) return Unexpected(std::move(opened).error());
      source_ = *std::move(opened);
    }
    if (auto frame = of_source()) return frame;
  }
}

std::optional<pipeline::Frame> LabelledFeed::of_source() {
  while (true) {
    auto scan = source_->next();
    if (!scan) {
      ++damaged_;
      warning_(to_string(scan.error()));
      continue;
    }
    if (!*scan) break;
    pipeline::Frame frame;
    frame.scan = **std::move(scan);
    const auto begin = std::chrono::steady_clock::now();
    pipeline::prepare(frame, {});
    frame.times.mount_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    return frame;
  }
  source_.reset();
  return std::nullopt;
}

}  // namespace verge::study
