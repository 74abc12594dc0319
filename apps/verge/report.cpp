// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "apps/verge/report.hpp"

#include <array>
#include <string_view>
#include <utility>

#include <fmt/core.h>

#include "apps/verge/mount_file.hpp"
#include "verge/core/angle.hpp"

namespace verge::app {
namespace {

std::string origin_of(const MountEstimate& estimate, const MountHint& hint) {
  const std::array given{hint.height_m.has_value(), hint.pitch_rad.has_value(), hint.roll_rad.has_value(),
                         hint.forward_rad.has_value()};
  constexpr std::array<std::string_view, 4> kNames{"height", "pitch", "roll", "forward"};
  std::string names;
  for (std::size_t i = 0; i < given.size(); ++i) {
    if (given[i]) names += fmt::format("{}{}", names.empty() ? "" : ", ", kNames[i]);
  }
  if (hint.height_m && hint.pitch_rad && hint.roll_rad && hint.forward_rad) return "given";
  std::string text =
      names.empty() ? "estimated from the scan" : names + " given, the rest estimated from the scan";
  if (!estimate.plane_found) text += "; no road surface found";
  if (!estimate.heading_found && !hint.forward_rad) text += "; no road direction found, +x taken";
  return text;
}

std::string spread(std::vector<double> values, int digits, std::string_view unit) {
  const double middle = pipeline::percentile(values, 0.5).value_or(0.0);
  const double low = pipeline::percentile(values, 0.1).value_or(0.0);
  const double high = pipeline::percentile(std::move(values), 0.9).value_or(0.0);
  return fmt::format("{:.{}f} {} ({:.{}f} to {:.{}f})", middle, digits, unit, low, digits, high, digits);
}

std::string mount_rows(const std::vector<Mount>& mounts) {
  const auto angle = [&](double Mount::*field) {
    auto values = pipeline::column<Mount>(mounts, field);
    for (double& value : values) value = rad_to_deg(value);
    return spread(std::move(values), 1, "deg");
  };
  return fmt::format("mount       height {}, pitch {}, roll {}, forward {}: median (p10 to p90)\n",
                     spread(pipeline::column<Mount>(mounts, &Mount::height_m), 2, "m"),
                     angle(&Mount::pitch_rad), angle(&Mount::roll_rad), angle(&Mount::forward_rad));
}

std::string stage_row(std::string_view name, const std::vector<double>& seconds) {
  const double p50 = pipeline::percentile(seconds, 0.5).value_or(0.0);
  const double p99 = pipeline::percentile(seconds, 0.99).value_or(0.0);
  return fmt::format("{:<10}  {:>8.2f}  {:>8.2f}\n", name, p50 * 1e3, p99 * 1e3);
}

std::string stage_rows(const std::vector<pipeline::StageTimes>& times) {
  using pipeline::StageTimes;
  std::string text = fmt::format("{:<10}  {:>8}  {:>8}\n", "stage", "p50 ms", "p99 ms");
  const auto add = [&](std::string_view name, double StageTimes::*field) {
    text += stage_row(name, pipeline::column<StageTimes>(times, field));
  };
  add("read", &StageTimes::read_s);
  add("mount", &StageTimes::mount_s);
  add("detect", &StageTimes::detect_s);
  add("write", &StageTimes::write_s);
  return text;
}

}  // namespace

std::string mount_line(const MountEstimate& estimate, const MountHint& hint) {
  return fmt::format("mount: {} ({})", to_text(estimate.mount), origin_of(estimate, hint));
}

std::string closing_table(const pipeline::Summary& summary, double seconds) {
  const auto& counts = summary.counts;
  const double rate = seconds > 0.0 ? static_cast<double>(counts.scans) / seconds : 0.0;
  std::string text = fmt::format("scans       {}{}  in {:.2f} s, {:.1f} scans/s\n", counts.scans,
                                 summary.interrupted ? " (interrupted)" : "", seconds, rate);
  if (counts.damaged > 0) text += fmt::format("damaged     {}\n", counts.damaged);
  text += fmt::format("boundaries  {}\n", counts.boundaries);
  if (!summary.mounts.empty()) text += mount_rows(summary.mounts) + stage_rows(summary.times);
  return text;
}

}  // namespace verge::app
