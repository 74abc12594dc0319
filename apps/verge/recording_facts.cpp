// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "apps/verge/recording_facts.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <string_view>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "verge/core/angle.hpp"
#include "verge/core/error.hpp"

namespace verge::app {
namespace {

using Json = nlohmann::ordered_json;
using Values = std::vector<double>;

std::vector<std::size_t> returns_of(const Scan& scan) {
  std::vector<std::size_t> indices;
  for (std::size_t i = 0; i < scan.size(); ++i) {
    if (scan.range[i] > 0.0F) indices.push_back(i);
  }
  return indices;
}

void add_extremes(const Values& values, Values& least, Values& greatest) {
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  least.push_back(*low);
  greatest.push_back(*high);
}

void add_geometry(RecordingFacts& facts, const Scan& scan) {
  const auto returns = returns_of(scan);
  if (returns.empty()) return;
  Values ranges;
  Values elevations;
  for (const std::size_t i : returns) {
    const Vec3 p = scan.point(i);
    ranges.push_back(static_cast<double>(scan.range[i]));
    elevations.push_back(std::atan2(p.z, norm(p.xy())));
  }
  add_extremes(ranges, facts.range_min_m, facts.range_max_m);
  add_extremes(elevations, facts.elevation_min_rad, facts.elevation_max_rad);
  facts.range_median_m.push_back(pipeline::percentile(std::move(ranges), 0.5).value_or(0.0));
}

void add_fields(RecordingFacts& facts, const Scan& scan) {
  const auto add_if = [&](bool present, const char* name) {
    if (present) facts.fields.insert(name);
  };
  add_if(!scan.intensity.empty(), "intensity");
  add_if(!scan.time_offset_ns.empty(), "time");
  add_if(!scan.echo.empty(), "echo");
  add_if(!scan.pulse_width.empty(), "pulse_width");
  add_if(!scan.flags.empty(), "flags");
  add_if(!scan.label.empty(), "label");
  add_if(scan.T_world_sensor.has_value(), "pose");
  add_if(scan.motion.has_value(), "motion");
}

void add_name(RecordingFacts& facts, const std::string& frame) {
  if (facts.first_and_last.size() == 2) facts.first_and_last.pop_back();
  facts.first_and_last.push_back(frame);
}

double least(const Values& values) { return pipeline::percentile(values, 1e-9).value_or(0.0); }
double middle(const Values& values) { return pipeline::percentile(values, 0.5).value_or(0.0); }
double greatest(const Values& values) { return pipeline::percentile(values, 1.0).value_or(0.0); }

std::string row(std::string_view name, const std::string& value) {
  return fmt::format("{:<10}  {}\n", name, value);
}

/// Without the sign of a negative number that rounds to 0.
std::string fixed(double value, int digits) {
  const double unit = std::pow(10.0, -digits);
  return fmt::format("{:.{}f}", std::fabs(value) < 0.5 * unit ? 0.0 : value, digits);
}

/// "32", or "31 to 32" where scans differ.
std::string extent(const Values& values, int digits) {
  const std::string low = fixed(least(values), digits);
  const std::string high = fixed(greatest(values), digits);
  return low == high ? low : fmt::format("{} to {}", low, high);
}

std::string points_text(const RecordingFacts& facts) {
  const auto& counts = facts.counts.points;
  std::string text = counts.received == 0 ? "0" : fmt::format("{} a scan", extent(facts.points, 0));
  if (facts.points.size() > 1) text += fmt::format(", {} in all", counts.received);
  if (counts.no_return > 0) text += fmt::format(", {} without return", counts.no_return);
  if (counts.not_finite > 0) text += fmt::format(", {} not finite", counts.not_finite);
  return text;
}

std::string seconds_text(std::int64_t ns) {
  return fmt::format("{}.{:09}", ns / 1'000'000'000, std::abs(ns % 1'000'000'000));
}

std::string time_text(const RecordingFacts& facts) {
  if (!facts.first_ns) return "unknown";
  if (facts.counts.scans < 2) return fmt::format("{} s", seconds_text(*facts.first_ns));
  const double length = static_cast<double>(*facts.last_ns - *facts.first_ns) * 1e-9;
  return fmt::format("{} to {} s ({:.3f} s)", seconds_text(*facts.first_ns), seconds_text(*facts.last_ns),
                     length);
}

Values degrees(const std::vector<Mount>& mounts, double Mount::*field) {
  Values values = pipeline::column<Mount>(mounts, field);
  for (double& value : values) value = rad_to_deg(value);
  return values;
}

std::string mount_text(const RecordingFacts& facts) {
  if (facts.mounts.empty()) return "no road surface found";
  return fmt::format("height {} m, pitch {} deg, roll {} deg, forward {} deg (estimated)",
                     extent(pipeline::column<Mount>(facts.mounts, &Mount::height_m), 2),
                     extent(degrees(facts.mounts, &Mount::pitch_rad), 1),
                     extent(degrees(facts.mounts, &Mount::roll_rad), 1),
                     extent(degrees(facts.mounts, &Mount::forward_rad), 1));
}

double rounded(double value) { return std::round(value * 1e4) / 1e4 + 0.0; }

Json extent_json(const Values& values) {
  if (values.empty()) return nullptr;
  return {{"min", rounded(least(values))},
          {"median", rounded(middle(values))},
          {"max", rounded(greatest(values))}};
}

Json limits_json(const Values& low, const Values& high) {
  if (low.empty()) return nullptr;
  return {{"min", rounded(least(low))}, {"max", rounded(greatest(high))}};
}

Values in_degrees(Values values) {
  for (double& value : values) value = rad_to_deg(value);
  return values;
}

Json optional_json(const std::optional<std::int64_t>& value) { return value ? Json(*value) : Json(nullptr); }

}  // namespace

void add(RecordingFacts& facts, const Scan& scan) {
  pipeline::add(facts.counts, scan, {});
  add_name(facts, scan.frame);
  add_geometry(facts, scan);
  add_fields(facts, scan);
  facts.points.push_back(static_cast<double>(scan.size() + scan.dropped));
  facts.rings.push_back(static_cast<double>(scan.ring_count()));
  if (!scan.intensity.empty()) {
    add_extremes(Values(scan.intensity.begin(), scan.intensity.end()), facts.intensity_min,
                 facts.intensity_max);
  }
  if (scan.stamp_ns) {
    facts.first_ns = std::min(facts.first_ns.value_or(*scan.stamp_ns), *scan.stamp_ns);
    facts.last_ns = std::max(facts.last_ns.value_or(*scan.stamp_ns), *scan.stamp_ns);
  }
  const MountEstimate estimate = estimate_mount(scan);
  if (estimate.plane_found) facts.mounts.push_back(estimate.mount);
}

std::string to_text(const RecordingFacts& facts) {
  const auto& counts = facts.counts;
  std::string text = row("format", facts.format);
  text += row("scans",
              fmt::format("{} ({}){}", counts.scans,
                          escape_control_bytes(fmt::format("{}", fmt::join(facts.first_and_last, " to "))),
                          counts.damaged > 0 ? fmt::format(", {} damaged", counts.damaged) : ""));
  text += row("points", points_text(facts));
  text += row("rings", extent(facts.rings, 0));
  if (!facts.range_min_m.empty()) {
    text += row("range", fmt::format("{:.2f} to {:.2f} m, median {:.2f} m", least(facts.range_min_m),
                                     greatest(facts.range_max_m), middle(facts.range_median_m)));
    text += row("elevation", fmt::format("{:.1f} to {:.1f} deg", rad_to_deg(least(facts.elevation_min_rad)),
                                         rad_to_deg(greatest(facts.elevation_max_rad))));
  }
  if (!facts.intensity_min.empty()) {
    text += row("intensity",
                fmt::format("{:.6g} to {:.6g}", least(facts.intensity_min), greatest(facts.intensity_max)));
  }
  text += row("fields",
              fmt::format("x, y, z{}{}", facts.fields.empty() ? "" : ", ", fmt::join(facts.fields, ", ")));
  text += row("time", time_text(facts));
  text += row("mount", mount_text(facts));
  for (const io::Counter& c : facts.counters) {
    if (c.count > 0) text += row("counted", fmt::format("{} {}", c.count, c.name));
  }
  for (const std::string& note : facts.notes) text += row("note", escape_control_bytes(note));
  return text;
}

std::string to_json(const RecordingFacts& facts) {
  const auto& counts = facts.counts;
  Json json{{"schema", 1}, {"format", facts.format}};
  json["scans"] = {
      {"received", counts.scans + counts.damaged}, {"used", counts.scans}, {"damaged", counts.damaged}};
  json["frames"] = facts.first_and_last;
  json["points"] = extent_json(facts.points);
  json["points_total"] = {{"received", counts.points.received},
                          {"used", counts.points.used},
                          {"not_finite", counts.points.not_finite},
                          {"no_return", counts.points.no_return}};
  json["rings"] = extent_json(facts.rings);
  json["range_m"] = limits_json(facts.range_min_m, facts.range_max_m);
  json["elevation_deg"] =
      limits_json(in_degrees(facts.elevation_min_rad), in_degrees(facts.elevation_max_rad));
  json["intensity"] = limits_json(facts.intensity_min, facts.intensity_max);
  json["fields"] = facts.fields;
  json["first_ns"] = optional_json(facts.first_ns);
  json["last_ns"] = optional_json(facts.last_ns);
  json["mount"] = {{"height_m", extent_json(pipeline::column<Mount>(facts.mounts, &Mount::height_m))},
                   {"pitch_deg", extent_json(degrees(facts.mounts, &Mount::pitch_rad))},
                   {"roll_deg", extent_json(degrees(facts.mounts, &Mount::roll_rad))},
                   {"forward_deg", extent_json(degrees(facts.mounts, &Mount::forward_rad))}};
  json["counters"] = Json::object();
  for (const io::Counter& counter : facts.counters) json["counters"][counter.name] = counter.count;
  json["notes"] = facts.notes;
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + '\n';
}

}  // namespace verge::app
