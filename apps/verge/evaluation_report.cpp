// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "apps/verge/evaluation_report.hpp"

#include <cmath>
#include <cstddef>
#include <optional>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include "verge/model/scene.hpp"

namespace verge::app {
namespace {

using nlohmann::ordered_json;

/// The scans of one shape of road, or all.
struct Group {
  std::string name;
  eval::BoundarySummary summary;
};

std::vector<Group> groups_of(const eval::Comparison& comparison, double tolerance_m) {
  std::vector<Group> groups;
  for (std::size_t shape = 0; shape < enum_names<eval::RoadShape>.size(); ++shape) {
    std::vector<eval::BoundaryErrors> scans;
    for (const eval::BoundaryErrors& scan : comparison.scans) {
      if (static_cast<std::size_t>(scan.shape) == shape) scans.push_back(scan);
    }
    if (scans.empty()) continue;
    groups.push_back(
        {std::string(enum_names<eval::RoadShape>.at(shape)), eval::summarise(scans, tolerance_m)});
  }
  groups.push_back({"all", eval::summarise(comparison.scans, tolerance_m)});
  return groups;
}

std::string metres(const std::optional<double>& value) {
  return value ? fmt::format("{:.3f}", *value) : std::string("-");
}

std::string percent(const std::optional<double>& share) {
  return share ? fmt::format("{:.1f}", 100.0 * *share) : std::string("-");
}

std::string row(const Group& group) {
  const eval::BoundarySummary& s = group.summary;
  return fmt::format("{:<10}{:>7}{:>8}{:>10}{:>10}{:>10}{:>10}{:>10}{:>10}\n", group.name, s.scans,
                     s.scans_without_prediction, s.predicted_samples, metres(s.median_m),
                     metres(s.percentile_95_m), metres(s.greatest_m), percent(s.share_right),
                     percent(s.share_covered));
}

ordered_json number(const std::optional<double>& value) {
  if (!value || !std::isfinite(*value)) return nullptr;
  return std::round(*value * 1e6) / 1e6;
}

ordered_json figures(const eval::BoundarySummary& s) {
  return {{"scans", s.scans},
          {"scans_without_prediction", s.scans_without_prediction},
          {"predicted_samples", s.predicted_samples},
          {"truth_samples", s.truth_samples},
          {"median_m", number(s.median_m)},
          {"percentile_95_m", number(s.percentile_95_m)},
          {"greatest_m", number(s.greatest_m)},
          {"share_right", number(s.share_right)},
          {"share_covered", number(s.share_covered)}};
}

ordered_json scan_json(const eval::BoundaryErrors& scan, double tolerance_m) {
  ordered_json json = {{"frame", scan.frame}, {"shape", name_of(scan.shape)}, {"predicted", scan.predicted}};
  ordered_json rest = figures(eval::summarise(std::span(&scan, 1), tolerance_m));
  rest.erase("scans");
  rest.erase("scans_without_prediction");
  json.update(rest);
  return json;
}

}  // namespace

std::string evaluation_table(const eval::Comparison& comparison, const eval::BoundaryErrorConfig& config) {
  std::string table = fmt::format(
      "Boundaries within {:g} m of the sensor against the truth: distance of each predicted sample (m), and\n"
      "how many of the predicted (right) and of the true samples (covered) lie within {:g} m of the "
      "other{}.\n\n"
      "{:<10}{:>7}{:>8}{:>10}{:>10}{:>10}{:>10}{:>10}{:>10}\n",
      config.range_m, config.tolerance_m, config.any_side ? " (of any side)" : " (of the same side)", "road",
      "scans", "empty", "samples", "median", "95 %", "greatest", "right %", "covered %");
  for (const Group& group : groups_of(comparison, config.tolerance_m)) table += row(group);
  return table;
}

std::string evaluation_json(const eval::Comparison& comparison, const eval::BoundaryErrorConfig& config) {
  ordered_json json = {{"range_m", config.range_m},
                       {"tolerance_m", config.tolerance_m},
                       {"step_m", config.step_m},
                       {"any_side", config.any_side}};
  for (const Group& group : groups_of(comparison, config.tolerance_m)) {
    json["groups"][group.name] = figures(group.summary);
  }
  json["scans"] = ordered_json::array();
  for (const eval::BoundaryErrors& scan : comparison.scans) {
    json["scans"].push_back(scan_json(scan, config.tolerance_m));
  }
  json["frames_without_truth"] = comparison.frames_without_truth;
  return json.dump(-1, ' ', false, ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace verge::app
