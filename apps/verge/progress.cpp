// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "apps/verge/progress.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include <fmt/core.h>

namespace verge::app {
namespace {

constexpr std::size_t kBarWidth = 24;

std::string bar(std::size_t done, std::size_t total) {
  const std::size_t filled = total == 0 ? kBarWidth : std::min(kBarWidth, kBarWidth * done / total);
  std::string text(filled, '=');
  if (filled < kBarWidth) text += '>';
  text.resize(kBarWidth, ' ');
  return text;
}

std::string clock_of(double seconds) {
  const auto whole = static_cast<std::int64_t>(std::ceil(seconds));
  if (whole < 3600) return fmt::format("{}:{:02}", whole / 60, whole % 60);
  return fmt::format("{}:{:02}:{:02}", whole / 3600, whole / 60 % 60, whole % 60);
}

}  // namespace

std::string progress_line(std::size_t done, std::optional<std::size_t> total, double seconds) {
  const std::string head = total ? fmt::format("[{}] {}/{} scans", bar(done, *total), done, *total)
                                 : fmt::format("{} scans", done);
  if (done == 0 || !(seconds > 0.0)) return head;
  const double rate = static_cast<double>(done) / seconds;
  const std::string with_rate = fmt::format("{}  {:.1f} scans/s", head, rate);
  if (!total) return with_rate;
  const double left = static_cast<double>(*total - std::min(done, *total)) / rate;
  return fmt::format("{}  ETA {}", with_rate, clock_of(left));
}

}  // namespace verge::app
